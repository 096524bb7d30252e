// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/light.h"

namespace patina {

/// Colour of a black body in linear Rec.709 with luminance 1, as UsdLuxBlackbodyTemperatureAsRgb
/// defines it: a Catmull-Rom spline through the Planckian locus at every 500 K.
/// @param kelvin clamped to 1000..10000; NaN counts as 6500
vec3 blackbodyColor(float kelvin);

/// Transform of something that moves, at a time; interpolated element by element.
/// @param origin of the space that it is wanted in, see seenFrom()
mat4 transformAt(const MotionTransform& transform, float time, const dvec3& origin = dvec3(0.0));
/// The same in all digits, for what is far from the origin.
dmat4 exactTransformAt(const MotionTransform& transform, float time);

/// World-space area that `normalize` divides by: rect and disk one side, sphere and cylinder
/// (without its caps) all of the outside, under any affine transform. Distant lights: the projected
/// solid angle pi sin^2(angle / 2), continued as pi (2 - sin^2) beyond 180 degrees, and 1 for angle
/// 0. Domes and mesh lights: 1 (the area of a mesh is its owner's to know).
double lightSizeFactor(const Light& light, const mat4& toWorld);
/// Size of an area light along the axes of its unit shape (shaders/lights/shape.glsl), before its
/// transform; 1 for other lights.
vec3 lightSize(const Light& light);
/// The name to report where a light of a shape has no size: an input that is 0, else the transform.
std::string lightSizeInput(const Light& light);

/// Radiance that a light emits before textures and shaping: intensity 2^exposure color blackbody,
/// divided by the size factor when `normalize` asks for it (UsdLux LightAPI). A distant light of
/// angle 0 gives irradiance on a plane that faces it instead.
/// May be infinite (a light without size that normalizes) or NaN when its inputs are.
vec3 lightRadiance(const Light& light, const mat4& toWorld);

/// lightRadiance() without the division.
vec3 lightBaseRadiance(const Light& light);

} // namespace patina
