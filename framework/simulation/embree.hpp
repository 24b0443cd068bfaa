#pragma once

// Embree 3 (Debian 12) and Embree 4 (Ubuntu 24.04) differ in the name of the header and in how a
// packet of rays is asked; this file hides both. Included by ray_caster.cpp alone.

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace croon::simulation {

/// The first hits of the rays of `packet` whose element of `valid` is -1; both aligned to 32 bytes.
/// The rays begin close together and look almost the same way.
inline void intersect_coherent(const int* valid, RTCScene scene, RTCRayHit8& packet) {
#if RTC_VERSION_MAJOR >= 4
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &packet, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &packet);
#endif
}

}  // namespace croon::simulation
