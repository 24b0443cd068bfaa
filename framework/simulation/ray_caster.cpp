#include "framework/simulation/ray_caster.hpp"

#include <tbb/task_arena.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <deque>
#include <mutex>
#include <optional>

#include "framework/simulation/embree.hpp"
#include "framework/simulation/inner_triangle.hpp"

namespace croon::simulation {
namespace {

using Eigen::Vector3d;

/// A mesh with its vertices in the world frame at evenly spaced times in the window. A static mesh
/// has one set of vertices, and its planes.
struct PlacedMesh {
  const Mesh* mesh = nullptr;
  std::vector<Points> steps;
  std::vector<Plane> planes;  ///< Of the triangles, in the world.

  bool moves() const { return steps.size() > 1; }
};

/// Between two steps a vertex moves straight and uniformly, whereas a turning body moves along an
/// arc: at 0.5 rad/s and 10 m/s they differ by up to 6 mm.
PlacedMesh placed(const Body& body, const Span& window_s) {
  constexpr double kMaxStep_s = 0.1;
  constexpr double kMaxSteps = 128.0;  // Embree's limit is one more.
  const bool moves = body.motion.speed_mps != 0.0 || body.motion.yaw_rate_radps != 0.0;
  double steps = 0.0;
  if (moves && window_s.length() > 0.0) {
    steps = std::clamp(std::ceil(window_s.length() / kMaxStep_s - 1e-9), 1.0, kMaxSteps);
  }
  PlacedMesh result{&body.mesh, {}, {}};
  for (double k = 0.0; k <= steps; ++k) {
    // The first and last are exactly at the ends of the window.
    double time_s = window_s.from;
    if (k > 0.0) time_s = k < steps ? window_s.from + k / steps * window_s.length() : window_s.to;
    result.steps.push_back(transformed(body.mesh.vertices, body.pose_at(time_s)));
  }
  return result;
}

void attach(RTCScene scene, const PlacedMesh& placed) {
  RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto steps = static_cast<unsigned int>(placed.steps.size());
  if (placed.moves()) rtcSetGeometryTimeStepCount(geometry, steps);
  for (unsigned int k = 0; k < steps; ++k) {
    set_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, k, RTC_FORMAT_FLOAT3, placed.steps[k]);
  }
  set_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, placed.mesh->triangles);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

/// The vertex `index` of a mesh at `time_ratio` of the window.
Vector3d vertex_at(const PlacedMesh& placed, std::uint32_t index, double time_ratio) {
  if (!placed.moves()) return placed.steps.front()[index].cast<double>();
  const double at = time_ratio * static_cast<double>(placed.steps.size() - 1);
  const std::size_t step = std::min(static_cast<std::size_t>(at), placed.steps.size() - 2);
  const Vector3d begin = placed.steps[step][index].cast<double>();
  const Vector3d end = placed.steps[step + 1][index].cast<double>();
  return begin + (at - static_cast<double>(step)) * (end - begin);
}

/// The corners of a triangle of a mesh at `time_ratio` of the window.
Corners corners_of(const PlacedMesh& placed, std::uint32_t triangle, double time_ratio) {
  const auto& [a, b, c] = placed.mesh->triangles[triangle];
  return {vertex_at(placed, a, time_ratio), vertex_at(placed, b, time_ratio),
          vertex_at(placed, c, time_ratio)};
}

std::vector<Plane> planes_of(const PlacedMesh& placed) {
  std::vector<Plane> planes;
  planes.reserve(placed.mesh->triangles.size());
  for (std::uint32_t i = 0; i < placed.mesh->triangles.size(); ++i) {
    planes.push_back(plane_of(corners_of(placed, i, 0.0)));
  }
  return planes;
}

struct Sphere {
  Vector3d centre;
  double radius_m = 0.0;
};

/// A sphere that contains a triangle, centred on its longest edge.
Sphere sphere_around(const Corners& corners) {
  Sphere sphere{corners[0]};
  double longest_m = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d& next = corners[(k + 1) % 3];
    const double length_m = (next - corners[k]).norm();
    if (length_m <= longest_m) continue;
    longest_m = length_m;
    sphere.centre = 0.5 * (next + corners[k]);
  }
  for (const Vector3d& corner : corners) {
    sphere.radius_m = std::max(sphere.radius_m, (corner - sphere.centre).norm());
  }
  return sphere;
}

/// Maximum difference between the ranges of hits that count as tied, because Embree computes in
/// single precision.
constexpr double kTied_m = 3e-4;
/// Maximum distance by which a ray may miss a triangle that single precision still hits.
constexpr double kMiss_m = 3e-5;

/// The intersection of a ray with the plane of a triangle.
struct PlaneHit {
  Hit hit;
  Corners corners;  ///< Of the triangle, relative to the origin of the ray.
  Vector3d normal;  ///< Zero if the triangle has no area.

  /// Whether the hit is on the triangle or at most kMiss_m off it.
  bool is_on_triangle(const Ray& ray) const;
};

/// With a vertex a, the normal n, the origin o and the direction d, the range to the triangle's
/// plane is n.(a - o) / n.d. Embree's own range is not used: it is computed with an approximate
/// reciprocal, whose bits depend on the processor.
PlaneHit hit_on_plane(const PlacedMesh& placed, std::uint32_t triangle, const Ray& ray,
                      double time_ratio) {
  Corners corners = corners_of(placed, triangle, time_ratio);
  for (Vector3d& corner : corners) corner -= ray.origin;
  const auto& [a, b, c] = corners;
  const Plane plane = plane_of(corners);
  const double cosine = plane.normal.dot(ray.direction);
  const auto [nearest, farthest] =
      std::minmax({a.dot(ray.direction), b.dot(ray.direction), c.dot(ray.direction)});
  // A ray in the plane intersects it everywhere, but hits the triangle.
  const double range_m =
      cosine == 0.0 ? nearest : std::clamp(-plane.offset_m / cosine, nearest, farthest);
  return {{range_m, std::abs(cosine), placed.mesh->materials[triangle]}, corners, plane.normal};
}

bool PlaneHit::is_on_triangle(const Ray& ray) const {
  const Vector3d point = hit.range_m * ray.direction;
  if (normal.isZero() || std::abs(normal.dot(point - corners[0])) > kMiss_m) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d outwards = outwards_of_edge(corners, k, normal);
    if (outwards.dot(point - corners[k]) > kMiss_m) return false;
  }
  return true;
}

/// The interior of a triangle, away from its edges, and all triangles that may be tied with a hit
/// there.
struct Interior {
  InnerTriangle inner;
  std::vector<TriangleId> near;
};

/// Cached information about a triangle from previous hits.
struct Visited {
  std::atomic<const Interior*> interior = nullptr;  ///< Null if unknown.
  std::atomic<int> hits = 0;                        ///< Before the interior was known.
};

}  // namespace

class RayCaster::Embree {
 public:
  Embree(const World& world, const Span& window_s) : window_s_(window_s) {
    add({&world.fixed, {world.fixed.vertices}, {}});
    for (const Body& body : world.bodies) add(placed(body, window_s));
    add(placed(world.car, window_s));
    scene_ = rtcNewScene(embree_device());
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
    for (const PlacedMesh& mesh : meshes_) attach(scene_, mesh);
    // On one thread: with several, the division of work may determine which of two triangles with a
    // common edge is hit.
    tbb::task_arena(1).execute([&] { rtcCommitScene(scene_); });
  }
  ~Embree() { rtcReleaseScene(scene_); }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  /// Casts `count` rays, at most eight, and writes their hits.
  void cast(const Ray* rays, std::size_t count, double min_m, double max_m, Hit* hits) const {
    Packet packet;
    for (std::size_t i = 0; i < count; ++i) {
      packet.set(i, rays[i], time_ratio(rays[i]), min_m, max_m);
    }
    intersect_coherent(scene_, packet);
    for (std::size_t i = 0; i < count; ++i) {
      const unsigned int mesh = packet.rays.hit.geomID[i];
      if (mesh == RTC_INVALID_GEOMETRY_ID) continue;
      hits[i] = decided({mesh, packet.rays.hit.primID[i]}, rays[i]);
    }
  }

 private:
  /// Adds a mesh unless it has no triangles, because Embree does not accept empty buffers.
  void add(PlacedMesh mesh) {
    if (mesh.mesh->triangles.empty()) return;
    if (!mesh.moves()) mesh.planes = planes_of(mesh);
    is_static_ = is_static_ && !mesh.moves();
    visited_.emplace_back(mesh.mesh->triangles.size());
    meshes_.push_back(std::move(mesh));
  }

  /// Whether a hit on the triangle may be tied with one at `point`, which requires that they are
  /// within kTied_m of each other and the former within kMiss_m of the triangle's plane. This
  /// excludes most triangles with nearby bounding boxes.
  bool may_be_tied(const TriangleId& id, const Vector3d& point) const {
    constexpr double kRounding_m = 1e-6;
    const std::vector<Plane>& planes = meshes_[id.first].planes;
    if (planes.empty()) return true;
    return std::abs(planes[id.second].signed_distance(point)) <= kTied_m + kMiss_m + kRounding_m;
  }

  Corners corners_of(const TriangleId& id) const {
    return simulation::corners_of(meshes_[id.first], id.second, 0.0);
  }

  /// The interior of the triangle, unless it is empty or has too many triangles nearby.
  std::optional<Interior> interior_of(const TriangleId& id) const {
    // At this distance from a common edge, triangles that meet at more than ten degrees are
    // kApart_m apart.
    constexpr double kInset_m = 4e-3;
    constexpr double kApart_m = 2.0 * kTied_m;
    constexpr std::size_t kMaxNear = 12;
    // With more triangles around, checking all of them costs more than it saves.
    constexpr int kMaxAround = 2000;
    const Corners corners = corners_of(id);
    Interior interior = {InnerTriangle(corners, kInset_m), {}};
    if (interior.inner.is_empty()) return std::nullopt;
    const Sphere sphere = sphere_around(corners);
    const double reach_m = sphere.radius_m + kApart_m;
    int around = 0;
    const auto compare = [&](const TriangleId& other) {
      ++around;
      const Plane& plane = meshes_[other.first].planes[other.second];
      const bool reaches = std::abs(plane.signed_distance(sphere.centre)) <= reach_m;
      if (reaches && other != id && !interior.inner.is_farther_than(kApart_m, corners_of(other))) {
        interior.near.push_back(other);
      }
      return around <= kMaxAround && interior.near.size() <= kMaxNear;
    };
    for_each_triangle_near(scene_, sphere.centre, reach_m, 0.0, compare);
    if (around > kMaxAround || interior.near.size() > kMaxNear) return std::nullopt;
    return interior;
  }

  /// The interior of the triangle `id`, if it is known and contains `point`. Whether a hit finds it
  /// known depends on the order of the threads, but affects only the run time.
  const Interior* known_interior(const TriangleId& id, const Vector3d& point) const {
    // Computing an interior costs about as much as this number of searches around a hit.
    constexpr int kOften = 6;
    if (!is_static_) return nullptr;
    Visited& triangle = visited_[id.first][id.second];
    const Interior* interior = triangle.interior.load(std::memory_order_acquire);
    if (interior == nullptr) {
      if (triangle.hits.fetch_add(1, std::memory_order_relaxed) + 1 != kOften) return nullptr;
      std::optional<Interior> found = interior_of(id);
      if (!found) return nullptr;
      const std::lock_guard lock(interiors_mutex_);
      interior = &interiors_.emplace_back(std::move(*found));
      triangle.interior.store(interior, std::memory_order_release);
    }
    return interior->inner.contains(point) ? interior : nullptr;
  }

  PlaneHit hit_on(const TriangleId& id, const Ray& ray) const {
    return hit_on_plane(meshes_[id.first], id.second, ray, time_ratio(ray));
  }

  /// The hit of a ray for which Embree found the triangle `found`. Where triangles meet or are
  /// coplanar, the last bits of Embree's ranges determine which one it finds. Returns the nearest
  /// of all tied hits, and of equal ones the one with the lowest ID.
  Hit decided(const TriangleId& found, const Ray& ray) const {
    const PlaneHit on_found = hit_on(found, ray);
    const double found_m = on_found.hit.range_m;
    const Vector3d point = ray.origin + found_m * ray.direction;
    std::optional<std::pair<double, TriangleId>> first;
    Hit hit = on_found.hit;
    const auto compare = [&](const TriangleId& id) {
      if (id == found || !may_be_tied(id, point)) return true;
      const PlaneHit other = hit_on(id, ray);
      const double other_m = other.hit.range_m;
      if (std::abs(other_m - found_m) > kTied_m || !other.is_on_triangle(ray)) return true;
      const std::pair<double, TriangleId> key{other_m, id};
      if (first && *first <= key) return true;
      first = key;
      hit = other.hit;
      return true;
    };
    if (const Interior* interior = known_interior(found, point)) {
      std::for_each(interior->near.begin(), interior->near.end(), compare);
    } else {
      for_each_triangle_near(scene_, point, 2.0 * kTied_m, time_ratio(ray), compare);
    }
    const bool is_first =
        !first || (std::pair{found_m, found} < *first && on_found.is_on_triangle(ray));
    return is_first ? on_found.hit : hit;
  }

  double time_ratio(const Ray& ray) const {
    const double length_s = window_s_.length();
    if (length_s <= 0.0) return 0.0;
    return std::clamp((ray.time_s - window_s_.from) / length_s, 0.0, 1.0);
  }

  Span window_s_;
  std::vector<PlacedMesh> meshes_;  ///< By Embree's geometry ID.
  bool is_static_ = true;           ///< Whether no mesh moves in the window.
  RTCScene scene_ = nullptr;
  mutable std::vector<std::vector<Visited>> visited_;  ///< By mesh and triangle.
  mutable std::deque<Interior> interiors_;
  mutable std::mutex interiors_mutex_;  ///< Guards `interiors_` while it grows.
};

RayCaster::RayCaster(std::shared_ptr<const World> world, Span window_s)
    : world_(std::move(world)), embree_(std::make_unique<Embree>(*world_, window_s)) {}

RayCaster::~RayCaster() = default;

std::vector<Hit> RayCaster::cast(const std::vector<Ray>& rays, double min_m, double max_m) const {
  std::vector<Hit> hits(rays.size());
  for (std::size_t i = 0; i < rays.size(); i += kPacketSize) {
    const std::size_t count = std::min(kPacketSize, rays.size() - i);
    embree_->cast(&rays[i], count, min_m, max_m, &hits[i]);
  }
  return hits;
}

}  // namespace croon::simulation
