#pragma once

#include "hdDelegate/scene/light.h"

namespace patina {

/// A point on a light's surface, as seen from the point that is lit.
struct ShapeSample {
    vec3 position{0.0f}, normal{0.0f}; ///< the normal is that of the side that emits
    float pdf = 0.0f;                  ///< solid angle density at the lit point
};

/// The surface of an area light in world space: a unit shape under an affine transform. In the
/// coordinates q = inverse (p - origin) the shapes are
///   rect      |q.x|, |q.y| <= 1/2, shining to `normal`
///   disk      q.x^2 + q.y^2 <= 1, shining to `normal`
///   sphere    |q| = 1, shining outwards
///   cylinder  |q.x| <= 1/2, q.y^2 + q.z^2 = 1, shining outwards, without caps
struct AreaShape {
    enum class Kind { Rect, Disk, Sphere, Cylinder };

    Kind kind = Kind::Rect;
    bool rightAngled = false; ///< a rect that is no mere parallelogram
    bool valid = false;       ///< has an area, and its transform can be inverted
    vec3 origin{0.0f}, normal{0.0f};
    mat3 axes{1.0f}, inverse{1.0f};
    float determinant = 1.0f, area = 0.0f;

    vec3 local(const vec3& position) const { return inverse * (position - origin); }
};

/// @param light of type rect, disk, sphere or cylinder
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

/// Grows a box by the shape.
void growBounds(const AreaShape& shape, vec3& low, vec3& high);

} // namespace patina
