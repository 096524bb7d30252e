// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/worldRays.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

RTCRay rayOf(const vec3& origin, const vec3& direction, float near, float far, float time,
             unsigned mask) {
    return {origin.x,    origin.y, origin.z, near, direction.x, direction.y,
            direction.z, time,     far,      mask, 0,           0};
}

} // namespace

bool WorldRays::finishHit(const RTCRayHit& rayHit, const TraceContext& context, Hit& hit) const {
    if (rayHit.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
    hit.time = rayHit.ray.time;
    hit.primitive = rayHit.hit.primID;
    hit.u = rayHit.hit.u;
    hit.v = rayHit.hit.v;
    hit.distance = rayHit.ray.tfar;
    hit.groupNormal = vec3(rayHit.hit.Ng_x, rayHit.hit.Ng_y, rayHit.hit.Ng_z);
    hit.instanced = false;
    hit.groupToWorld = mat4(1.0f);
    hit.instanceId = -1;
    hit.instanceCategories = nullptr;
    hit.stepCount = 0;

    const EmbreeGroup* group = _world;
    unsigned native = rayHit.hit.instID[0];
    const auto enter = [&](const InstancerNode& node, int instance) {
        hit.instanced = true;
        hit.groupToWorld = hit.groupToWorld * node.transformAt(instance, hit.time);
        hit.instanceId = node.id(instance, hit.instanceId);
        if (size_t(instance) < node.categories.size())
            hit.instanceCategories = &node.categories[instance];
        hit.steps[hit.stepCount++] = {node.values.get(), instance};
    };
    if (native == throughUserGeometry) {
        for (int i = 0; i < context.hitDepth; ++i)
            enter(*context.hitChain[i].record->node, context.hitChain[i].instance);
        group = context.hitGroup;
        native = context.hitNative;
    }
    if (native != RTC_INVALID_GEOMETRY_ID) {
        const GroupRecord& record = *group->records[native];
        if (record.surface) { // one of many implicit prims that share their triangles
            hit.instanced = true;
            hit.groupToWorld = hit.groupToWorld * record.surface->placeAt(hit.time);
            hit.surface = record.surface;
            return true;
        }
        enter(*record.node, record.instance);
        group = record.node->targets[record.instance];
    }
    hit.surface = group->records[rayHit.hit.geomID]->surface;
    return hit.surface != nullptr;
}

bool WorldRays::accepts(const RTCRay& ray) const {
    if (isTraceable(ray, _world->rayLimit)) return true;
    const bool clipped = ray.tfar < 0.0f; // there is nothing wrong with such a ray
    if (!clipped && !_warnedOfRays.exchange(true))
        _diagnostics.warn("", "rays", messages::raysUnusable);
    return false;
}

bool WorldRays::intersect(const vec3& origin, const vec3& direction, float near, float far,
                          float time, unsigned mask, Hit& hit) const {
    TraceContext context(_world);
    RTCRayHit rayHit;
    rayHit.ray = rayOf(origin, direction, near, far, time, mask);
    if (!accepts(rayHit.ray)) return false;
    rayHit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rayHit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    embreeIntersect(_world->scene, &context.base, &rayHit);
    return finishHit(rayHit, context, hit);
}

bool WorldRays::occluded(const vec3& origin, const vec3& direction, float near, float far,
                         float time, unsigned mask) const {
    TraceContext context(_world);
    RTCRay ray = rayOf(origin, direction, near, far, time, mask);
    if (!accepts(ray)) return true;
    embreeOccluded(_world->scene, &context.base, &ray);
    return ray.tfar < 0.0f;
}

unsigned WorldRays::occludedRays(const vec3& origin, const vec3* directions, int count, float time,
                                 unsigned mask) const {
    TraceContext context(_world);
    alignas(64) RTCRay16 rays;
    alignas(64) int valid[packet];
    unsigned blocked = 0;
    for (int i = 0; i < packet; ++i) {
        RTCRay ray = rayOf(origin, directions[std::min(i, count - 1)], 0.0f, INFINITY, time, mask);
        valid[i] = i < count && accepts(ray) ? -1 : 0;
        if (i < count && !valid[i]) blocked |= 1u << i;
        if (!valid[i]) // builds of Embree with assertions look at rays that are left out, too
            ray = rayOf(vec3(0.0f), vec3(0.0f, 0.0f, 1.0f), 0.0f, 0.0f, time, mask);
        rays.org_x[i] = ray.org_x, rays.org_y[i] = ray.org_y, rays.org_z[i] = ray.org_z;
        rays.dir_x[i] = ray.dir_x, rays.dir_y[i] = ray.dir_y, rays.dir_z[i] = ray.dir_z;
        rays.tnear[i] = ray.tnear, rays.tfar[i] = ray.tfar, rays.time[i] = ray.time;
        rays.mask[i] = ray.mask, rays.id[i] = unsigned(i), rays.flags[i] = 0;
    }
    embreeOccluded16(valid, _world->scene, &context.base, &rays);
    for (int i = 0; i < count; ++i)
        if (valid[i] && rays.tfar[i] < 0.0f) blocked |= 1u << i;
    return blocked;
}

} // namespace patina
