// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/embreeGroup.h"

#include "hdDelegate/embree/embreeErrors.h"
#include "hdDelegate/embree/embreeGeometry.h"
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
    if (!isTraceable(local.ray, target->rayLimit)) return;
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
    const auto* record = static_cast<const GroupRecord*>(args->geometryUserPtr);
    auto& context = *reinterpret_cast<TraceContext*>(args->context);
    if (context.depth >= TraceContext::maxDepth) return;
    const int instance = record->instances[args->primID];
    const EmbreeGroup* target = record->node->targets[instance];
    for (unsigned i = 0; i < args->N; ++i) {
        if (!args->valid[i]) continue;
        const RTCRay ray = rtcGetRayFromRayN(args->ray, args->N, i);
        RTCRay local =
            transformRay(ray, glm::inverse(record->node->transformAt(instance, ray.time)));
        if (!isTraceable(local, target->rayLimit)) continue;
        Descent descent(context, record, instance, target);
        embreeOccluded(target->scene, &context.base, &local);
        if (local.tfar < 0.0f) RTCRayN_tfar(args->ray, args->N, i) = -INFINITY;
    }
}

/// How large coordinates of rays may be for Embree to take them into an instance.
/// @param at the transform at a time
template <class At> float rayLimitOf(const At& at, bool moves) {
    constexpr int times = 16; // between them a transform is not far from one of them
    float largest = 1.0f;
    for (int t = 0; t <= (moves ? times : 0); ++t) {
        const mat4 inverse = glm::inverse(at(float(t) / times));
        for (int c = 0; c < 3; ++c)
            largest = std::max(
                {largest, std::abs(inverse[c].x), std::abs(inverse[c].y), std::abs(inverse[c].z)});
    }
    return largestTraced / (6.0f * largest);
}

bool goesOn(void* stop, double) {
    return !*static_cast<const std::atomic<bool>*>(stop);
}

} // namespace

void EmbreeGroup::clear() {
    if (scene) rtcReleaseScene(scene);
    scene = nullptr;
    _surfaces.clear();
    _nodes.clear();
    records.clear();
}

unsigned EmbreeGroup::freeId() {
    for (size_t i = _firstFree; i < records.size(); ++i)
        if (!records[i]) {
            _firstFree = i + 1;
            return unsigned(i);
        }
    records.emplace_back();
    _firstFree = records.size();
    return unsigned(records.size() - 1);
}

void EmbreeGroup::attach(RTCGeometry geometry, unsigned id, unsigned mask, GroupRecord record) {
    changed = true;
    rtcSetGeometryMask(geometry, mask);
    records[id] = std::make_unique<GroupRecord>(std::move(record));
    if (records[id]->node && records[id]->instance < 0)
        rtcSetGeometryUserData(geometry, records[id].get());
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, id);
    rtcReleaseGeometry(geometry);
}

void EmbreeGroup::detach(unsigned id) {
    changed = true;
    rtcDetachGeometry(scene, id);
    records[id].reset();
    _firstFree = std::min(_firstFree, size_t(id));
}

void EmbreeGroup::showTo(SurfaceMember& member, unsigned mask) {
    if (mask == member.mask) return;
    changed = true;
    RTCGeometry geometry = rtcGetGeometry(scene, member.id);
    rtcSetGeometryMask(geometry, member.mask = mask);
    rtcCommitGeometry(geometry);
}

void EmbreeGroup::attachSurface(RTCDevice device, const std::shared_ptr<Surface>& surface, int id,
                                std::map<std::string, SurfaceMember>& members) {
    RTCGeometry geometry = makeGeometry(device, *surface);
    if (!geometry) return;
    const bool free = id >= 0 && !records[size_t(id)];
    SurfaceMember member{surface, surface->prim->visibility.mask(), free ? unsigned(id) : freeId()};
    if (surface->shared)
        member.rayLimit = rayLimitOf([&](float time) { return surface->placeAt(time); },
                                     surface->places.size() > 1);
    GroupRecord record;
    record.surface = surface.get();
    attach(geometry, member.id, member.mask, std::move(record));
    members[surface->prim->path] = std::move(member);
}

void EmbreeGroup::updateSurfaces(RTCDevice device, const Surfaces& surfaces) {
    std::map<std::string, SurfaceMember> next;
    for (const auto& surface : surfaces) {
        const std::string& path = surface->prim->path;
        const auto old = _surfaces.find(path);
        if (old != _surfaces.end() && old->second.surface == surface) {
            next.insert(_surfaces.extract(old));
            showTo(next[path], surface->prim->visibility.mask());
        }
    }
    for (const auto& item : _surfaces)
        detach(item.second.id);
    for (const auto& surface : surfaces) {
        const std::string& path = surface->prim->path;
        if (next.count(path)) continue;
        // A changed prim keeps its id, so that the order stays that of a new scene.
        const auto old = _surfaces.find(path);
        attachSurface(device, surface, old == _surfaces.end() ? -1 : int(old->second.id), next);
    }
    _surfaces = std::move(next);
}

void EmbreeGroup::replace(RTCDevice device, const Surfaces& surfaces, const Nodes* nodes,
                          const std::atomic<bool>& stop) {
    changed = false;
    _broken = true;
    rtcGetDeviceError(device); // what is not of this update
    _firstFree = 0;
    for (const auto& surface : surfaces) {
        const auto old = _surfaces.find(surface->prim->path);
        int id = -1;
        if (old != _surfaces.end()) {
            if (old->second.surface == surface) {
                showTo(old->second, surface->prim->visibility.mask());
                continue;
            }
            id = int(old->second.id);
            detach(old->second.id);
            _surfaces.erase(old);
        }
        attachSurface(device, surface, id, _surfaces);
        const auto added = _surfaces.find(surface->prim->path);
        if (added != _surfaces.end()) rayLimit = std::min(rayLimit, added->second.rayLimit);
    }
    if (nodes) updateNodes(device, *nodes);
    commit(device, stop);
}

void EmbreeGroup::attachNode(RTCDevice device, NodeMember& member) {
    const InstancerNode& node = *member.node;
    const auto maskOf = [&prim = *node.prim](int i) {
        const unsigned own = prim.marks.empty() ? ~0u : prim.marks[size_t(i)].visibility.mask();
        return prim.visibility.mask() & own;
    };
    GroupRecord record;
    record.node = &node;
    std::map<unsigned, std::vector<int>> nested; // by mask
    for (int i = 0; i < int(node.targets.size()); ++i) {
        EmbreeGroup* target = node.targets[i];
        if (!target || target->empty()) continue;
        if (target->hasInstances || node.collapses[size_t(i)]) {
            nested[maskOf(i)].push_back(i);
            continue;
        }
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(geometry, target->scene);
        rtcSetGeometryTimeStepCount(geometry, unsigned(node.steps));
        const auto at = [&](float time) { return node.transformAt(i, time); };
        member.rayLimit = std::min(member.rayLimit, rayLimitOf(at, node.steps > 1));
        for (int step = 0; step < node.steps; ++step)
            rtcSetGeometryTransform(geometry, unsigned(step), RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                    &node.transforms[size_t(i) * node.steps + step]);
        record.instance = i;
        member.ids.push_back(freeId());
        attach(geometry, member.ids.back(), maskOf(i), record);
    }
    for (auto& [mask, instances] : nested) {
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(geometry, unsigned(instances.size()));
        rtcSetGeometryTimeStepCount(geometry, unsigned(node.steps));
        rtcSetGeometryBoundsFunction(geometry, instanceBounds, nullptr);
        rtcSetGeometryIntersectFunction(geometry, instanceIntersect);
        rtcSetGeometryOccludedFunction(geometry, instanceOccluded);
        record.instance = -1;
        record.instances = std::move(instances);
        member.ids.push_back(freeId());
        attach(geometry, member.ids.back(), mask, record);
    }
}

void EmbreeGroup::updateNodes(RTCDevice device, const Nodes& nodes) {
    std::map<std::string, NodeMember> next;
    for (const auto& node : nodes) {
        const auto old = _nodes.find(node->prim->path);
        if (old != _nodes.end() && old->second.node == node) next.insert(_nodes.extract(old));
    }
    for (const auto& item : _nodes)
        for (const unsigned id : item.second.ids)
            detach(id);
    for (const auto& node : nodes) {
        if (next.count(node->prim->path)) continue;
        NodeMember member{node, {}};
        attachNode(device, member);
        if (!member.ids.empty()) next[node->prim->path] = std::move(member);
    }
    _nodes = std::move(next);
    hasInstances = !_nodes.empty();
    rayLimit = largestTraced;
    for (const auto& item : _nodes)
        rayLimit = std::min(rayLimit, item.second.rayLimit);
    for (const auto& item : _surfaces)
        rayLimit = std::min(rayLimit, item.second.rayLimit);
}

void EmbreeGroup::update(RTCDevice device, const Surfaces& surfaces, const Nodes& nodes,
                         Structure structure, const std::atomic<bool>& stop) {
    changed = false;
    if (scene && (_broken || _structure != structure)) clear();
    _broken = true;
    rtcGetDeviceError(device); // what is not of this update
    _structure = structure;
    _firstFree = 0;
    if (!scene) {
        changed = true;
        scene = rtcNewScene(device);
        const bool editable = structure == Structure::Editable;
        const RTCSceneFlags flag = editable                          ? RTC_SCENE_FLAG_DYNAMIC
                                   : structure == Structure::Compact ? RTC_SCENE_FLAG_COMPACT
                                                                     : RTC_SCENE_FLAG_NONE;
        rtcSetSceneFlags(scene, RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | flag));
        // At low quality Embree keeps a hierarchy per geometry and rebuilds those that changed.
        rtcSetSceneBuildQuality(scene, editable ? RTC_BUILD_QUALITY_LOW : RTC_BUILD_QUALITY_MEDIUM);
        rtcSetSceneProgressMonitorFunction(scene, goesOn, const_cast<std::atomic<bool>*>(&stop));
    }
    updateSurfaces(device, surfaces);
    updateNodes(device, nodes);
    commit(device, stop);
}

void EmbreeGroup::commit(RTCDevice device, const std::atomic<bool>& stop) {
    throwIfOutOfMemory(device);
    if (changed) rtcCommitScene(scene);
    throwIfOutOfMemory(device);
    _broken = changed && stop; // perhaps in the middle of the commit
}

} // namespace patina
