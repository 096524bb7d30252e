#pragma once

// What the files of areaShape.h share.

#include "hdDelegate/lights/areaShape.h"

#include "materialNetwork/maths.h"

#include <cmath>

namespace patina {

/// Turns a density over area into one over solid angle; 0 where the surface faces away.
inline float areaToSolidAngle(float pdfArea, const vec3& point, const vec3& position,
                              const vec3& normal) {
    const vec3 v = point - position;
    const float d2 = glm::dot(v, v), projected = glm::dot(v, normal);
    return projected > 0.0f && d2 > 0.0f ? pdfArea * d2 * std::sqrt(d2) / projected : 0.0f;
}

bool sampleSphere(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out);
float spherePdf(const AreaShape& shape, const vec3& point, const vec3& position);
bool sampleCylinder(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out);
float cylinderPdf(const AreaShape& shape, const vec3& point, const vec3& position,
                  const vec3& normal);

} // namespace patina
