// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/areaShape.h"

#include "hdDelegate/lights/sphericalRect.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Whether a rect is sampled by solid angle. One that is far beside its longer edge looks alike
/// from all of its places, and area sampling is cheaper.
bool bySolidAngle(const AreaShape& shape, const vec3& point) {
    if (!shape.rightAngled) return false;
    const vec3 v = point - shape.origin;
    const float longest =
        std::max(glm::dot(shape.axes[0], shape.axes[0]), glm::dot(shape.axes[1], shape.axes[1]));
    return longest > 0.1f * glm::dot(v, v);
}

bool rectFrom(const AreaShape& shape, const vec3& point, SphericalRect& rect) {
    const vec3 corner = shape.origin - 0.5f * (shape.axes[0] + shape.axes[1]);
    return rect.setup(corner, shape.axes[0], shape.axes[1], point);
}

bool facesPlane(const AreaShape& shape, const vec3& point) {
    return glm::dot(point - shape.origin, shape.normal) > 0.0f;
}

float byArea(const AreaShape& shape, const vec3& point, const vec3& position) {
    return shLights::areaToSolidAngle(1.0f / shape.area, point - position, shape.normal);
}

AreaShape::Kind kindOf(LightType type) {
    switch (type) {
#define PATINA_LIGHT(Type, word, schemas, hydra)                                                   \
    case LightType::Type: break;
        // area lights have a row with more columns
#define PATINA_AREA_LIGHT(Type, ...)                                                               \
    case LightType::Type: return AreaShape::Kind::Type;
        // one case per row
#include "hdDelegate/scene/lightTypes.inc"
    }
    return AreaShape::Kind::Sphere;
}

/// Of shapes that no receiver has samples of its own for.
float placePdf(const AreaShape& shape, const vec3& point, const vec3& position,
               const vec3& normal) {
    const vec3 q = shLights::shapeLocal(shape, position);
    return shLights::areaToSolidAngle(shLights::shapePlaceDensity(int(shape.kind), shape, q),
                                      point - position, normal);
}

} // namespace

AreaShape makeAreaShape(const Light& light, const mat4& toWorld) {
    AreaShape s;
    s.kind = kindOf(light.type);
    s.flat = lightRow(light.type).flat;
    const vec3 size = lightSize(light);
    s.origin = vec3(toWorld[3]);
    glm::dmat3 axes;
    for (int i = 0; i < 3; ++i)
        axes[i] = glm::dvec3(vec3(toWorld[i])) * double(size[i]);
    s.area = float(lightSizeFactor(light, toWorld));
    if (s.flat) {
        // The plane's own normal takes the place of the third axis, on the side of local -z.
        const glm::dvec3 n = glm::cross(axes[0], axes[1]);
        const double length = glm::length(n);
        const double side = glm::dot(n, axes[2]) < 0.0 ? 1.0 : -1.0;
        axes[2] = n * (side / length);
        s.normal = vec3(axes[2]);
        const double across = std::abs(glm::dot(axes[0], axes[1]));
        s.rightAngled = across <= 1e-5 * glm::length(axes[0]) * glm::length(axes[1]);
    }
    s.axes = mat3(axes);
    const double det = glm::determinant(axes);
    s.volume = float(std::abs(det));
    s.inverse = mat3(glm::inverse(axes));
    bool finite = std::isfinite(s.area) && std::isfinite(s.volume);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            finite = finite && std::isfinite(s.axes[i][k]) && std::isfinite(s.inverse[i][k]);
    for (int k = 0; k < 3; ++k)
        finite = finite && std::isfinite(s.origin[k]);
    s.valid = finite && s.area > 0.0f && s.volume > 0.0f;
    return s;
}

bool sampleShape(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out) {
    if (shape.kind == AreaShape::Kind::Sphere) return shLights::sphereSample(shape, point, u, out);
    if (shape.kind == AreaShape::Kind::Cylinder)
        return shLights::cylinderSample(shape, point, u, out) && std::isfinite(out.pdf);
    if (shape.flat && !facesPlane(shape, point)) return false;
    if (shape.kind != AreaShape::Kind::Rect && shape.kind != AreaShape::Kind::Disk) {
        const vec3 q = shLights::shapePlace(int(shape.kind), u);
        out.position = shape.origin + shape.axes * q;
        out.normal = shLights::shapeNormalAt(int(shape.kind), shape, q);
        out.pdf = placePdf(shape, point, out.position, out.normal);
        return out.pdf > 0.0f && std::isfinite(out.pdf);
    }
    out.normal = shape.normal;
    if (shape.kind == AreaShape::Kind::Rect) {
        SphericalRect rect;
        if (bySolidAngle(shape, point) && rectFrom(shape, point, rect)) {
            out.position = rect.sample(u);
            out.pdf = rect.pdf();
            return true;
        }
        const vec2 q = u - 0.5f;
        out.position = shape.origin + q.x * shape.axes[0] + q.y * shape.axes[1];
    } else {
        const vec2 q = concentricDisk(u);
        out.position = shape.origin + q.x * shape.axes[0] + q.y * shape.axes[1];
    }
    out.pdf = byArea(shape, point, out.position);
    return out.pdf > 0.0f;
}

float shapePdf(const AreaShape& shape, const vec3& point, const vec3& position,
               const vec3& normal) {
    if (shape.kind == AreaShape::Kind::Sphere) return shLights::spherePdf(shape, point, position);
    if (shape.kind == AreaShape::Kind::Cylinder)
        return shLights::cylinderPdf(shape, point, position, normal);
    if (shape.flat && !facesPlane(shape, point)) return 0.0f;
    if (shape.kind != AreaShape::Kind::Rect && shape.kind != AreaShape::Kind::Disk)
        return placePdf(shape, point, position, normal);
    SphericalRect rect;
    if (shape.kind == AreaShape::Kind::Rect && bySolidAngle(shape, point) &&
        rectFrom(shape, point, rect))
        return rect.pdf();
    return byArea(shape, point, position);
}

bool intersectShape(const AreaShape& shape, const vec3& origin, const vec3& direction, float near,
                    float far, float& distance, vec3& normal) {
    const vec3 o = shapeLocal(shape, origin), d = shape.inverse * direction;
    vec3 q;
    if (!shLights::shapeHit(int(shape.kind), o, d, distance, q)) return false;
    if (!(distance > near && distance < far)) return false;
    normal = shapeNormalAt(int(shape.kind), shape, q);
    return true;
}

bool isFlatShape(int number) {
    switch (number) {
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, flat, ...)                           \
    case shLights::SHAPE_##number: return flat;
        // one case per row
#include "hdDelegate/scene/lightTypes.inc"
    default: return false;
    }
}

void growBounds(const AreaShape& shape, vec3& low, vec3& high) {
    const vec3 extent = shLights::shapeExtent(int(shape.kind), shape);
    low = glm::min(low, shape.origin - extent);
    high = glm::max(high, shape.origin + extent);
}

} // namespace patina
