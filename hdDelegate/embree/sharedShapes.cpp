// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sharedShapes.h"

#include "hdDelegate/embree/embreeErrors.h"
#include "hdDelegate/geometry/implicitFaces.h"
#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool onlyScales(const Implicit& prim) {
    return prim.shape == ImplicitShape::Sphere || prim.shape == ImplicitShape::Cube;
}

/// Whether rays can be taken into the space of a prim at all times.
bool staysApart(const Implicit& prim) {
    float minimum = INFINITY, maximum = 0.0f;
    const auto stays = [&](const mat4& m) {
        const mat4 place = m * SharedShapes::placement(prim);
        const float volume = std::abs(glm::determinant(mat3(place)));
        minimum = std::min(minimum, volume);
        maximum = std::max(maximum, volume);
        return isWideEnough(place);
    };
    const auto& values = prim.transform.values;
    for (size_t i = 0; i < values.size(); ++i) {
        if (!stays(mat4(values[i]))) return false;
        if (i > 0 && !stays(mat4(0.5 * values[i - 1] + 0.5 * values[i]))) return false;
    }
    return minimum >= 1e-3f * maximum;
}

/// A prim of this key, without anything of its own.
Implicit plain(const Implicit& prim) {
    Implicit out;
    out.path = prim.path;
    out.shape = prim.shape;
    out.axis = prim.axis;
    out.leftHanded = prim.leftHanded;
    out.radius = prim.radius;
    out.radiusTop = prim.radiusTop;
    out.height = prim.height;
    out.size = prim.size;
    out.width = prim.width;
    out.length = prim.length;
    if (onlyScales(prim)) {
        out.radius = 1.0f;
        out.size = 1.0f;
    }
    return out;
}

} // namespace

SharedShape::~SharedShape() {
    if (scene) rtcReleaseScene(scene);
}

std::optional<ShapeKey> SharedShapes::keyOf(const Implicit& prim, float roundEdge) {
    if (countsFaces(prim) || prim.axis < 0 || prim.axis > 2) return std::nullopt;
    for (float size : {prim.radius, prim.height, prim.size, prim.width, prim.length})
        if (!(size > 0.0f) || !std::isfinite(size)) return std::nullopt;
    if (!std::isfinite(prim.radiusTop) || !staysApart(prim)) return std::nullopt;
    const float kind = float(int(prim.shape) * 8 + prim.axis * 2 + int(prim.leftHanded));
    const float coarser = float(roundCoarseness(prim, roundEdge));
    if (onlyScales(prim)) return ShapeKey{kind, coarser, 0, 0, 0, 0, 0, 0, 0};
    return ShapeKey{
        kind, coarser, prim.radius, prim.radiusTop, prim.height, prim.width, prim.length, 0, 0};
}

mat4 SharedShapes::placement(const Implicit& prim) {
    if (prim.shape == ImplicitShape::Sphere) return glm::scale(mat4(1.0f), vec3(prim.radius));
    if (prim.shape == ImplicitShape::Cube) return glm::scale(mat4(1.0f), vec3(prim.size));
    return mat4(1.0f);
}

void SharedShapes::update(RTCDevice device, const std::map<ShapeKey, int>& uses,
                          const std::map<ShapeKey, const Implicit*>& examples,
                          Diagnostics& diagnostics) {
    std::map<ShapeKey, std::shared_ptr<const SharedShape>> next;
    rtcGetDeviceError(device); // what is not of this update
    for (const auto& [key, count] : uses) {
        if (count < minInstances) continue;
        auto& known = _shapes[key];
        if (!known) {
            auto shape = std::make_shared<SharedShape>();
            const Implicit prim = plain(*examples.at(key));
            TessellationOptions options;
            if (key[1] > 1.0f)
                options.roundEdge = roundEdgeOf(std::max(prim.radius, prim.radiusTop), int(key[1]));
            shape->mesh = tessellate(prim, options, diagnostics);
            if (shape->mesh.triangles.empty()) continue;
            shape->scene = rtcNewScene(device);
            rtcSetSceneFlags(shape->scene, RTC_SCENE_FLAG_ROBUST);
            RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
            const auto& positions = shape->mesh.positions[0];
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                       positions.data(), 0, sizeof(vec3), positions.size());
            rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                       shape->mesh.triangles.data(), 0, sizeof(uvec3),
                                       shape->mesh.triangles.size());
            rtcSetGeometryMask(geometry, 0xffffffffu); // that of the instance counts
            rtcCommitGeometry(geometry);
            rtcAttachGeometry(shape->scene, geometry);
            rtcReleaseGeometry(geometry);
            throwIfOutOfMemory(device);
            rtcCommitScene(shape->scene);
            throwIfOutOfMemory(device);
            known = std::move(shape);
        }
        next[key] = known;
    }
    _shapes = std::move(next);
}

std::shared_ptr<const SharedShape> SharedShapes::find(const ShapeKey& key) const {
    const auto found = _shapes.find(key);
    return found == _shapes.end() ? nullptr : found->second;
}

size_t SharedShapes::triangles() const {
    size_t sum = 0;
    for (const auto& item : _shapes)
        sum += item.second->mesh.triangles.size();
    return sum;
}

size_t SharedShapes::bytes() const {
    size_t sum = 0;
    for (const auto& item : _shapes) {
        const TriangleMesh& mesh = item.second->mesh;
        sum += (mesh.positions[0].size() + mesh.normals[0].size()) * sizeof(vec3) +
               mesh.triangles.size() * sizeof(uvec3);
    }
    return sum;
}

} // namespace patina
