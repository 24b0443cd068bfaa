#pragma once

// A thin layer over Embree's C interface, included by ray_caster.cpp and its test. Embree 3 (Debian
// 12) and Embree 4 (Ubuntu 24.04) differ in the name of the header and in the call for a packet of
// rays.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <memory>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "framework/simulation/ray_caster.hpp"

namespace croon::simulation {

constexpr std::size_t kPacketSize = 8;

/// Eight rays in Embree's layout. `valid` is -1 for rays in use, otherwise 0. Unused rays are zero,
/// because Debian's Embree checks their values too.
struct alignas(32) Packet {
  RTCRayHit8 rays = {};
  int valid[kPacketSize] = {};

  /// Sets the ray `i`.
  void set(std::size_t i, const Ray& ray, double time_ratio, double min_m, double max_m) {
    RTCRay8& r = rays.ray;
    r.org_x[i] = static_cast<float>(ray.origin.x());
    r.org_y[i] = static_cast<float>(ray.origin.y());
    r.org_z[i] = static_cast<float>(ray.origin.z());
    r.dir_x[i] = static_cast<float>(ray.direction.x());
    r.dir_y[i] = static_cast<float>(ray.direction.y());
    r.dir_z[i] = static_cast<float>(ray.direction.z());
    r.tnear[i] = static_cast<float>(min_m);
    r.tfar[i] = static_cast<float>(max_m);
    r.time[i] = static_cast<float>(time_ratio);
    r.mask[i] = 0xffffffffU;
    r.id[i] = 0;
    r.flags[i] = 0;
    rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    valid[i] = -1;
  }
};

/// Finds the first hits of the packet's rays, which begin close together and have almost the same
/// direction.
inline void intersect_coherent(RTCScene scene, Packet& packet) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(packet.valid, scene, &packet.rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(packet.valid, scene, &context, &packet.rays);
#endif
}

/// The device that all scenes share. Embree's code paths for different processors decide
/// differently where two triangles meet; this device uses the one that runs on every x86-64,
/// whatever Embree's configuration files specify. Throws std::system_error if Embree cannot create
/// a device for lack of memory.
inline RTCDevice embree_device() {
  static const struct Device {
    RTCDevice handle = rtcNewDevice("isa=sse2,ignore_config_files=1");
    ~Device() { rtcReleaseDevice(handle); }
  } device;
  if (device.handle == nullptr) {
    throw std::system_error(std::make_error_code(std::errc::not_enough_memory),
                            "Embree does not start");
  }
  return device.handle;
}

/// The IDs of a geometry and of one of its triangles.
using TriangleId = std::pair<unsigned int, unsigned int>;

/// Calls `use(id)` for all triangles whose bounding boxes are within `radius_m` of `point`, and for
/// some others nearby, in any order, until it returns false; a few more calls may follow.
template <class Use>
void for_each_triangle_near(RTCScene scene, const Eigen::Vector3d& point, double radius_m,
                            double time_ratio, const Use& use) {
  RTCPointQuery query;
  query.x = static_cast<float>(point.x());
  query.y = static_cast<float>(point.y());
  query.z = static_cast<float>(point.z());
  query.time = static_cast<float>(time_ratio);
  query.radius = static_cast<float>(radius_m);
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  const auto call = [](RTCPointQueryFunctionArguments* found) {
    const bool goes_on =
        (*static_cast<const Use*>(found->userPtr))(TriangleId(found->geomID, found->primID));
    if (!goes_on) found->query->radius = 0.0F;
    return !goes_on;  // Whether the radius changed.
  };
  rtcPointQuery(scene, &query, &context, call, const_cast<Use*>(&use));
}

/// Copies `elements` into a new buffer of `geometry`; `slot` is the time step of vertices.
template <class Element>
void set_buffer(RTCGeometry geometry, RTCBufferType type, unsigned int slot, RTCFormat format,
                const std::vector<Element>& elements) {
  void* const buffer =
      rtcSetNewGeometryBuffer(geometry, type, slot, format, sizeof(Element), elements.size());
  if (buffer == nullptr) throw std::bad_alloc();
  std::uninitialized_copy(elements.begin(), elements.end(), static_cast<Element*>(buffer));
}

}  // namespace croon::simulation
