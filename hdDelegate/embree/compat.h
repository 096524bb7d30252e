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

#endif

} // namespace patina
