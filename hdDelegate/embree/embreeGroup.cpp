#include "hdDelegate/embree/embreeGroup.h"

#include "hdDelegate/embree/embreeScene.h"

#include <algorithm>
#include <cmath>

namespace patina {

mat4 InstancerNode::transformAt(int instance, float time) const {
    const mat4* first = &transforms[size_t(instance) * steps];
    if (steps == 1) return *first;
    const float x = std::clamp(time, 0.0f, 1.0f) * float(steps - 1);
    const int i = std::min(int(x), steps - 2);
    const float f = x - float(i);
    return first[i] * (1.0f - f) + first[i + 1] * f;
}

int InstancerNode::id(int instance, int outer) const {
    const int own = size_t(instance) < prim->ids.size() ? prim->ids[instance] : instance;
    if (outer < 0 || prim->idCounts.empty()) return own;
    const int prototype = prim->prototypeIndices[instance]; // drawn instances have one
    if (size_t(prototype) >= prim->idCounts.size()) return own;
    return int(uint32_t(outer) * uint32_t(prim->idCounts[prototype]) + uint32_t(own));
}

EmbreeGroup::~EmbreeGroup() {
    if (scene) rtcReleaseScene(scene);
}

namespace {

unsigned maskOf(const Visibility& visibility) {
    return (visibility.camera ? unsigned(RayCamera) : 0u) |
           (visibility.indirect ? unsigned(RayIndirect) : 0u) |
           (visibility.shadow ? unsigned(RayShadow) : 0u);
}

/// The ray in the space of one instance. The direction keeps its scale, so distances stay equal.
RTCRay transformRay(const RTCRay& ray, const mat4& worldToLocal) {
    RTCRay local = ray;
    const vec3 o = vec3(worldToLocal * vec4(ray.org_x, ray.org_y, ray.org_z, 1.0f));
    const vec3 d = mat3(worldToLocal) * vec3(ray.dir_x, ray.dir_y, ray.dir_z);
    local.org_x = o.x, local.org_y = o.y, local.org_z = o.z;
    local.dir_x = d.x, local.dir_y = d.y, local.dir_z = d.z;
    return local;
}

/// Enters an instance for the time of one callback.
struct Descent {
    TraceContext& context;
    const EmbreeGroup* outer;

    Descent(TraceContext& c, const GroupRecord* record, int instance, const EmbreeGroup* target)
        : context(c), outer(c.group) {
        context.stack[context.depth++] = {record, instance};
        context.group = target;
    }
    ~Descent() {
        --context.depth;
        context.group = outer;
    }
};

void instanceBounds(const RTCBoundsFunctionArguments* args) {
    const auto* record = static_cast<const GroupRecord*>(args->geometryUserPtr);
    const int instance = record->instances[args->primID];
    const EmbreeGroup* target = record->node->targets[instance];
    RTCBounds local;
    rtcGetSceneBounds(target->scene, &local);
    vec3 lower(INFINITY), upper(-INFINITY);
    const int steps = record->node->steps;
    const int first = int(args->timeStep) < steps ? int(args->timeStep) : 0;
    const mat4& m = record->node->transforms[size_t(instance) * steps + first];
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p((corner & 1) ? local.upper_x : local.lower_x,
                     (corner & 2) ? local.upper_y : local.lower_y,
                     (corner & 4) ? local.upper_z : local.lower_z);
        const vec3 w = vec3(m * vec4(p, 1.0f));
        lower = glm::min(lower, w);
        upper = glm::max(upper, w);
    }
    *args->bounds_o = {lower.x, lower.y, lower.z, 0, upper.x, upper.y, upper.z, 0};
}

void instanceIntersect(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto* record = static_cast<const GroupRecord*>(args->geometryUserPtr);
    auto& context = *reinterpret_cast<TraceContext*>(args->context);
    if (context.depth >= TraceContext::maxDepth) return;
    auto* rayHit = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const int instance = record->instances[args->primID];
    const EmbreeGroup* target = record->node->targets[instance];
    const mat4 inverse = glm::inverse(record->node->transformAt(instance, rayHit->ray.time));

    RTCRayHit local;
    local.ray = transformRay(rayHit->ray, inverse);
    local.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    local.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Descent descent(context, record, instance, target);
    embreeIntersect(target->scene, &context.base, &local);
    if (local.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    if (local.hit.instID[0] != throughUserGeometry) {
        context.hitDepth = context.depth;
        std::copy_n(context.stack, context.depth, context.hitChain);
        context.hitGroup = target;
        context.hitNative = local.hit.instID[0];
    }
    rayHit->ray.tfar = local.ray.tfar;
    rayHit->hit = local.hit;
    rayHit->hit.instID[0] = throughUserGeometry;
}

void instanceOccluded(const RTCOccludedFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto* record = static_cast<const GroupRecord*>(args->geometryUserPtr);
    auto& context = *reinterpret_cast<TraceContext*>(args->context);
    if (context.depth >= TraceContext::maxDepth) return;
    auto* ray = reinterpret_cast<RTCRay*>(args->ray);
    const int instance = record->instances[args->primID];
    const EmbreeGroup* target = record->node->targets[instance];
    RTCRay local = transformRay(*ray, glm::inverse(record->node->transformAt(instance, ray->time)));
    Descent descent(context, record, instance, target);
    embreeOccluded(target->scene, &context.base, &local);
    if (local.tfar < 0.0f) ray->tfar = -INFINITY;
}

void shareBuffer(RTCGeometry geometry, RTCBufferType type, unsigned slot, RTCFormat format,
                 const void* data, size_t stride, size_t count) {
    rtcSetSharedGeometryBuffer(geometry, type, slot, format, data, 0, stride, count);
}

RTCGeometry makeTriangles(RTCDevice device, const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryTimeStepCount(geometry, unsigned(mesh.positions.size()));
    for (size_t step = 0; step < mesh.positions.size(); ++step)
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT3,
                    mesh.positions[step].data(), sizeof(vec3), mesh.positions[step].size());
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.triangles.data(),
                sizeof(uvec3), mesh.triangles.size());
    return geometry;
}

RTCGeometryType curveType(const CurveSet& curves) {
    const bool ribbon = !curves.normals.empty();
    switch (curves.basis) {
    case CurveBasis::Bezier:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_BEZIER_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_BEZIER_CURVE;
    case CurveBasis::Bspline:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_BSPLINE_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_BSPLINE_CURVE;
    case CurveBasis::CatmullRom:
        return ribbon ? RTC_GEOMETRY_TYPE_NORMAL_ORIENTED_CATMULL_ROM_CURVE
                      : RTC_GEOMETRY_TYPE_ROUND_CATMULL_ROM_CURVE;
    default: return RTC_GEOMETRY_TYPE_ROUND_LINEAR_CURVE;
    }
}

RTCGeometry makeCurves(RTCDevice device, const CurveSet& curves) {
    RTCGeometry geometry = rtcNewGeometry(device, curveType(curves));
    rtcSetGeometryTimeStepCount(geometry, unsigned(curves.controlPoints.size()));
    for (size_t step = 0; step < curves.controlPoints.size(); ++step) {
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT4,
                    curves.controlPoints[step].data(), sizeof(vec4),
                    curves.controlPoints[step].size());
        if (!curves.normals.empty() && curves.basis != CurveBasis::Linear)
            shareBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, unsigned(step), RTC_FORMAT_FLOAT3,
                        curves.normals[std::min(step, curves.normals.size() - 1)].data(),
                        sizeof(vec3), curves.controlPoints[step].size());
    }
    shareBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT, curves.segments.data(),
                sizeof(uint32_t), curves.segments.size());
    return geometry;
}

RTCGeometry makePoints(RTCDevice device, const PointSet& points) {
    const bool discs = !points.normals.empty();
    RTCGeometry geometry = rtcNewGeometry(device, discs ? RTC_GEOMETRY_TYPE_ORIENTED_DISC_POINT
                                                        : RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetGeometryTimeStepCount(geometry, unsigned(points.points.size()));
    for (size_t step = 0; step < points.points.size(); ++step) {
        shareBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, unsigned(step), RTC_FORMAT_FLOAT4,
                    points.points[step].data(), sizeof(vec4), points.points[step].size());
        if (discs)
            shareBuffer(geometry, RTC_BUFFER_TYPE_NORMAL, unsigned(step), RTC_FORMAT_FLOAT3,
                        points.normals[std::min(step, points.normals.size() - 1)].data(),
                        sizeof(vec3), points.points[step].size());
    }
    return geometry;
}

} // namespace

void EmbreeGroup::build(RTCDevice device) {
    if (scene) rtcReleaseScene(scene);
    scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    records.clear();
    hasInstances = false;

    const auto attach = [&](RTCGeometry geometry, unsigned mask, GroupRecord record) {
        rtcSetGeometryMask(geometry, mask);
        records.push_back(std::make_unique<GroupRecord>(std::move(record)));
        if (records.back()->node && records.back()->instance < 0)
            rtcSetGeometryUserData(geometry, records.back().get());
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(scene, geometry, unsigned(records.size() - 1));
        rtcReleaseGeometry(geometry);
    };

    for (const auto& surface : surfaces) {
        RTCGeometry geometry = nullptr;
        if (surface->shape == Surface::Shape::Triangles && !surface->mesh.triangles.empty())
            geometry = makeTriangles(device, surface->mesh);
        else if (surface->shape == Surface::Shape::Curves && !surface->curves.segments.empty())
            geometry = makeCurves(device, surface->curves);
        else if (surface->shape == Surface::Shape::Points && !surface->points.points.empty() &&
                 !surface->points.points[0].empty())
            geometry = makePoints(device, surface->points);
        if (!geometry) continue;
        GroupRecord record;
        record.surface = surface.get();
        attach(geometry, maskOf(surface->prim->visibility), std::move(record));
    }

    for (const auto& node : nodes) {
        const unsigned mask = maskOf(node->prim->visibility);
        std::vector<int> nested;
        for (int i = 0; i < int(node->targets.size()); ++i) {
            EmbreeGroup* target = node->targets[i];
            if (!target || target->records.empty()) continue;
            hasInstances = true;
            if (target->hasInstances) {
                nested.push_back(i);
                continue;
            }
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
            rtcSetGeometryInstancedScene(geometry, target->scene);
            rtcSetGeometryTimeStepCount(geometry, unsigned(node->steps));
            for (int step = 0; step < node->steps; ++step)
                rtcSetGeometryTransform(geometry, unsigned(step), RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                        &node->transforms[size_t(i) * node->steps + step]);
            GroupRecord record;
            record.node = node.get();
            record.instance = i;
            attach(geometry, mask, std::move(record));
        }
        if (nested.empty()) continue;
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, unsigned(nested.size()));
        rtcSetGeometryTimeStepCount(geometry, unsigned(node->steps));
        rtcSetGeometryBoundsFunction(geometry, instanceBounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, instanceIntersect);
        rtcSetGeometryOccludedFunction(geometry, instanceOccluded);
        GroupRecord record;
        record.node = node.get();
        record.instances = std::move(nested);
        attach(geometry, mask, std::move(record));
    }
    rtcCommitScene(scene);
}

} // namespace patina
