// SPDX-License-Identifier: Apache-2.0
// Stands between a renderer and Embree (LD_PRELOAD): notes the rays that are traced while it is
// asked to, and traces them once more, with nothing around. testenv/bench/rayBench.py builds it,
// with hdDelegate/embree/compat.h before it.
//
// Rays that callbacks of a scene trace are not noted: they are traced again with the ray that asked
// for them. Contexts are plain ones, so scenes whose callbacks need more cannot be replayed.
#include <dlfcn.h>
#include <vector>

namespace {

struct Traced {
    RTCScene scene;
    RTCRay ray;
    bool occluded;
};

std::vector<Traced> traced;
bool recording = false;
int depth = 0; // of calls; a renderer with one thread is recorded

template <class Function> Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

void note(RTCScene scene, const RTCRay& ray, bool occluded) {
    if (recording && depth == 1) traced.push_back({scene, ray, occluded});
}

} // namespace

#if PATINA_EMBREE_MAJOR >= 4
#define RECORDED(name, Ray, Args, ray, isOccluded)                                                 \
    void name(RTCScene scene, Ray* traced, Args* args) {                                           \
        static const auto real = next<void(RTCScene, Ray*, Args*)>(#name);                         \
        ++depth;                                                                                   \
        note(scene, ray, isOccluded);                                                              \
        real(scene, traced, args);                                                                 \
        --depth;                                                                                   \
    }
#else
#define RECORDED(name, Ray, Args, ray, isOccluded)                                                 \
    void name(RTCScene scene, RTCIntersectContext* context, Ray* traced) {                         \
        static const auto real = next<void(RTCScene, RTCIntersectContext*, Ray*)>(#name);          \
        ++depth;                                                                                   \
        note(scene, ray, isOccluded);                                                              \
        real(scene, context, traced);                                                              \
        --depth;                                                                                   \
    }
#endif

extern "C" {

RECORDED(rtcIntersect1, RTCRayHit, RTCIntersectArguments, traced->ray, false)
RECORDED(rtcOccluded1, RTCRay, RTCOccludedArguments, *traced, true)

void patinaRecord(int on) {
    recording = on != 0;
    if (recording) traced.clear();
}

long patinaRecorded(int occluded) {
    long count = 0;
    for (const Traced& t : traced)
        count += t.occluded == (occluded != 0);
    return count;
}

/// @returns how many of them met something
long patinaReplay() {
    long hits = 0;
    for (const Traced& t : traced) {
        patina::EmbreeContext context;
        patina::initContext(&context);
        if (t.occluded) {
            RTCRay ray = t.ray;
            patina::embreeOccluded(t.scene, &context, &ray);
            hits += ray.tfar < 0.0f;
            continue;
        }
        RTCRayHit rayHit;
        rayHit.ray = t.ray;
        rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        patina::embreeIntersect(t.scene, &context, &rayHit);
        hits += rayHit.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
    return hits;
}

} // extern "C"
