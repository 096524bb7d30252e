// SPDX-License-Identifier: Apache-2.0
#pragma once

// The differences between Embree 3 and 4 stand here and nowhere else.

#if PATINA_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace patina {

#if PATINA_EMBREE_MAJOR >= 4

using EmbreeContext = RTCRayQueryContext;
inline void initContext(EmbreeContext* context) {
    rtcInitRayQueryContext(context);
}

inline void embreeIntersect(RTCScene scene, EmbreeContext* context, RTCRayHit* rayHit) {
    RTCIntersectArguments args;
    rtcInitIntersectArguments(&args);
    args.context = context;
    args.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcIntersect1(scene, rayHit, &args);
}

inline void embreeOccluded(RTCScene scene, EmbreeContext* context, RTCRay* ray) {
    RTCOccludedArguments args;
    rtcInitOccludedArguments(&args);
    args.context = context;
    args.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcOccluded1(scene, ray, &args);
}

/// @param valid -1 for each ray to trace, aligned to 64 bytes as the rays are
inline void embreeOccluded16(const int* valid, RTCScene scene, EmbreeContext* context,
                             RTCRay16* rays) {
    RTCOccludedArguments args;
    rtcInitOccludedArguments(&args);
    args.context = context;
    args.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcOccluded16(valid, scene, rays, &args);
}

#else

using EmbreeContext = RTCIntersectContext;
inline void initContext(EmbreeContext* context) {
    rtcInitIntersectContext(context);
}

inline void embreeIntersect(RTCScene scene, EmbreeContext* context, RTCRayHit* rayHit) {
    rtcIntersect1(scene, context, rayHit);
}

inline void embreeOccluded(RTCScene scene, EmbreeContext* context, RTCRay* ray) {
    rtcOccluded1(scene, context, ray);
}

/// @param valid -1 for each ray to trace, aligned to 64 bytes as the rays are
inline void embreeOccluded16(const int* valid, RTCScene scene, EmbreeContext* context,
                             RTCRay16* rays) {
    rtcOccluded16(valid, scene, context, rays);
}

#endif

} // namespace patina
