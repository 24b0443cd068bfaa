#include "framework/simulation/ray_caster.hpp"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

#include "framework/simulation/embree.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kLanes = 8;

/// A mesh with its vertices in the world at the two ends of the window; `end` is empty where
/// nothing moves.
struct PlacedMesh {
  const Mesh* mesh = nullptr;
  PointCloud begin;
  PointCloud end;
};

PlacedMesh placed(const Body& body, const TimeWindow& window) {
  PlacedMesh result{&body.mesh, transformed(body.mesh.vertices, body.pose_at(window.begin_s)), {}};
  const bool moves = body.motion.speed_mps != 0.0 || body.motion.yaw_rate_radps != 0.0;
  if (moves && window.end_s > window.begin_s) {
    result.end = transformed(body.mesh.vertices, body.pose_at(window.end_s));
  }
  return result;
}

RTCDevice device() {
  static const struct Device {
    RTCDevice handle = rtcNewDevice(nullptr);
    ~Device() { rtcReleaseDevice(handle); }
  } device;
  if (device.handle == nullptr) throw std::runtime_error("Embree finds no device to run on");
  return device.handle;
}

void set_vertices(RTCGeometry geometry, const PointCloud& vertices, unsigned int time_step) {
  void* const buffer =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, time_step, RTC_FORMAT_FLOAT3,
                              sizeof(Eigen::Vector3f), vertices.size());
  if (buffer == nullptr) throw std::bad_alloc();
  std::memcpy(buffer, vertices.data(), vertices.size() * sizeof(Eigen::Vector3f));
}

void attach(RTCScene scene, const PlacedMesh& placed) {
  RTCGeometry geometry = rtcNewGeometry(device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!placed.end.empty()) rtcSetGeometryTimeStepCount(geometry, 2);
  set_vertices(geometry, placed.begin, 0);
  if (!placed.end.empty()) set_vertices(geometry, placed.end, 1);
  const auto& triangles = placed.mesh->triangles;
  void* const indices =
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(triangles.front()), triangles.size());
  if (indices == nullptr) throw std::bad_alloc();
  std::memcpy(indices, triangles.data(), triangles.size() * sizeof(triangles.front()));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

/// Eight rays as Embree takes them, and which of them are there.
struct alignas(32) Packet {
  RTCRayHit8 rays;
  int valid[kLanes];
};

void set_lane(Packet& packet, std::size_t lane, const Ray& ray, float time_ratio, double min_m,
              double max_m) {
  RTCRay8& r = packet.rays.ray;
  r.org_x[lane] = static_cast<float>(ray.origin.x());
  r.org_y[lane] = static_cast<float>(ray.origin.y());
  r.org_z[lane] = static_cast<float>(ray.origin.z());
  r.dir_x[lane] = static_cast<float>(ray.direction.x());
  r.dir_y[lane] = static_cast<float>(ray.direction.y());
  r.dir_z[lane] = static_cast<float>(ray.direction.z());
  r.tnear[lane] = static_cast<float>(min_m);
  r.tfar[lane] = static_cast<float>(max_m);
  r.time[lane] = time_ratio;
  r.mask[lane] = 0xffffffffU;
  r.id[lane] = 0;
  r.flags[lane] = 0;
  packet.rays.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
  packet.rays.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  packet.valid[lane] = -1;
}

/// The corner `index` of a mesh at `time_ratio` of the window.
Vector3d corner(const PlacedMesh& placed, std::uint32_t index, double time_ratio) {
  const Vector3d begin = placed.begin[index].cast<double>();
  if (placed.end.empty()) return begin;
  return begin + time_ratio * (placed.end[index].cast<double>() - begin);
}

/// The hit on a triangle that Embree found at `found_m`: the range to the triangle's plane,
/// n.(a - o) / n.d.
Hit hit_on_triangle(const PlacedMesh& placed, std::uint32_t triangle, const Ray& ray,
                    double time_ratio, double found_m) {
  const auto& [a, b, c] = placed.mesh->triangles[triangle];
  const Vector3d first = corner(placed, a, time_ratio);
  const Vector3d normal = (corner(placed, b, time_ratio) - first)
                              .cross(corner(placed, c, time_ratio) - first)
                              .normalized();
  const double cosine = normal.dot(ray.direction);
  Hit hit{found_m, std::abs(cosine), placed.mesh->materials[triangle]};
  const double range_m = normal.dot(first - ray.origin) / cosine;
  // A ray along the plane has no one range; Embree's is then as good as any.
  if (std::abs(range_m - found_m) < 1e-3 * (1.0 + found_m)) hit.range_m = range_m;
  return hit;
}

}  // namespace

class RayCaster::Embree {
 public:
  Embree(const World& world, const TimeWindow& window) : window_(window) {
    add({&world.fixed, world.fixed.vertices, {}});
    for (const Body& body : world.bodies) add(placed(body, window));
    add(placed(world.car, window));
    scene_ = rtcNewScene(device());
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    for (const PlacedMesh& mesh : meshes_) attach(scene_, mesh);
    // One thread: how Embree divides its work among several may decide which of two triangles that
    // share an edge is hit.
    tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
  }
  ~Embree() { rtcReleaseScene(scene_); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  /// Casts `count` rays, at most eight, and writes their hits.
  void cast(const Ray* rays, std::size_t count, double min_m, double max_m, Hit* hits) const {
    Packet packet;
    std::fill(std::begin(packet.valid), std::end(packet.valid), 0);
    for (std::size_t i = 0; i < count; ++i) {
      set_lane(packet, i, rays[i], static_cast<float>(time_ratio(rays[i])), min_m, max_m);
    }
    intersect_coherent(packet.valid, scene_, packet.rays);
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned int mesh = packet.rays.hit.geomID[i];
      if (mesh == RTC_INVALID_GEOMETRY_ID) continue;
      hits[i] = hit_on_triangle(meshes_[mesh], packet.rays.hit.primID[i], rays[i],
                                time_ratio(rays[i]), packet.rays.ray.tfar[i]);
    }
  }

 private:
  /// Meshes without triangles are left out: Embree takes no empty buffers.
  void add(PlacedMesh mesh) {
    if (!mesh.mesh->triangles.empty()) meshes_.push_back(std::move(mesh));
  }

  double time_ratio(const Ray& ray) const {
    const double length_s = window_.end_s - window_.begin_s;
    if (length_s <= 0.0) return 0.0;
    return std::clamp((ray.time_s - window_.begin_s) / length_s, 0.0, 1.0);
  }

  TimeWindow window_;
  std::vector<PlacedMesh> meshes_;  ///< By Embree's number of the geometry.
  RTCScene scene_ = nullptr;
};

RayCaster::RayCaster(std::shared_ptr<const World> world, TimeWindow window)
    : world_(std::move(world)), embree_(std::make_unique<Embree>(*world_, window)) {}

RayCaster::~RayCaster() = default;

std::vector<Hit> RayCaster::cast(const std::vector<Ray>& rays, double min_m, double max_m) const {
  std::vector<Hit> hits(rays.size());
  for (std::size_t i = 0; i < rays.size(); i += kLanes) {
    embree_->cast(&rays[i], std::min(kLanes, rays.size() - i), min_m, max_m, &hits[i]);
  }
  return hits;
}

}  // namespace croon::simulation
