// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/light.h"
#include "shaders/lights.h"

namespace patina {

using ShapeSample = shLights::ShapePoint;

/// The surface of an area light in world space: a unit shape under an affine transform, see
/// shaders/lights/shape.glsl.
struct AreaShape : shLights::ShapeFrame {
    /// The numbers are those of shaders/lights/shapes.
    enum class Kind {
#define PATINA_AREA_LIGHT(Type, word, schemas, hydra, number, ...) Type = shLights::SHAPE_##number,
#include "hdDelegate/scene/lightTypes.inc"
    };

    Kind kind = Kind::Rect;
    bool flat = true;         ///< shines to one side of a plane
    bool rightAngled = false; ///< a rect that is no mere parallelogram
    bool valid = false;       ///< has an area, and its transform can be inverted
    vec3 normal{0.0f};        ///< of flat ones
    float area = 0.0f;

    AreaShape() : ShapeFrame{vec3(0.0f), mat3(1.0f), mat3(1.0f), 1.0f} {}
};

/// @param light of a type with a shape; others count as spheres
AreaShape makeAreaShape(const Light& light, const mat4& toWorld);

/// Chooses a point on the shape: spheres by the cone (under affine transforms too) that they fill,
/// rects by solid angle where they are large (Urena et al. 2013), cylinders by angle along and by
/// projected width across, the rest by area.
/// @returns false when no part that emits faces the point
bool sampleShape(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out);

/// Solid angle density with which sampleShape() chooses a position on the shape.
float shapePdf(const AreaShape& shape, const vec3& point, const vec3& position, const vec3& normal);

/// The first point of the shape's emitting side that a ray meets.
bool intersectShape(const AreaShape& shape, const vec3& origin, const vec3& direction, float near,
                    float far, float& distance, vec3& normal);

/// @param number of shaders/lights/shapes; false of others
bool isFlatShape(int number);

/// Grows a box by the shape.
void growBounds(const AreaShape& shape, vec3& low, vec3& high);

} // namespace patina
