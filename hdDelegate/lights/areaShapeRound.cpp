// Spheres and cylinders, seen from outside.

#include "hdDelegate/lights/areaShapeParts.h"

#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// 1 - cos of the half angle under which a unit sphere is seen from squared distance d2 > 1.
float coneHeight(float d2) {
    const float sine2 = 1.0f / d2;
    return sine2 / (1.0f + std::sqrt(std::max(0.0f, 1.0f - sine2)));
}

/// Where on the line of the cylinder that is nearest to the point the samples centre.
struct CylinderView {
    float phi, rho;      ///< the point in the cross-section, polar; rho > 1
    float half;          ///< half the angle under which the cross-section is seen
    float middle, scale; ///< x = (t - middle) * scale, and t has density ~ 1 / (1 + x^2)
    float a, angle;      ///< x at t = -1/2, and the angle over which atan x goes
};

bool viewCylinder(const AreaShape& shape, const vec3& point, CylinderView& view) {
    const vec3 q = shape.local(point);
    const float rho2 = q.y * q.y + q.z * q.z;
    if (!(rho2 > 1.0f)) return false;
    view.phi = std::atan2(q.z, q.y);
    view.rho = std::sqrt(rho2);
    view.half = std::asin(std::min(1.0f, 1.0f / view.rho));
    const vec3 along = shape.axes[0];
    const vec3 start =
        shape.origin + std::cos(view.phi) * shape.axes[1] + std::sin(view.phi) * shape.axes[2];
    const float length2 = glm::dot(along, along), length = std::sqrt(length2);
    view.middle = glm::dot(point - start, along) / length2;
    const float away = glm::length(point - (start + view.middle * along));
    view.scale = length / std::max(away, 1e-3f * length);
    view.a = (-0.5f - view.middle) * view.scale;
    const float b = (0.5f - view.middle) * view.scale;
    // atan b - atan a without the cancellation far beyond an end
    view.angle = std::atan2(b - view.a, 1.0f + view.a * b);
    return view.angle > 0.0f;
}

float cylinderAreaPdf(const AreaShape& shape, const CylinderView& view, float t, float phi) {
    const float x = (t - view.middle) * view.scale;
    const float along = view.scale / ((1.0f + x * x) * view.angle);
    // Across, the angle psi at the point is uniform: d(phi) = (rho cos psi / cos i - 1) d(psi),
    // where i = delta + psi is the angle at the surface.
    const float delta = phi - view.phi;
    const float psi = std::atan2(std::sin(delta), view.rho - std::cos(delta));
    const float cosI = std::cos(delta + psi), distance = view.rho * std::cos(psi) - cosI;
    if (!(cosI > 0.0f && distance > 0.0f)) return 0.0f;
    const float around = cosI / (2.0f * view.half * distance);
    const vec3 tangent = -std::sin(phi) * shape.axes[1] + std::cos(phi) * shape.axes[2];
    return along * around / glm::length(glm::cross(shape.axes[0], tangent));
}

} // namespace

bool sampleSphere(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out) {
    const vec3 q = shape.local(point);
    const float d2 = glm::dot(q, q);
    if (!(d2 > 1.0f)) return false;
    const float height = coneHeight(d2);
    const float h = u.x * height; // 1 - cos
    const float sine2 = h * (2.0f - h), cosine = 1.0f - h;
    const float d = std::sqrt(d2), phi = 2.0f * pi * u.y;
    const vec3 axis = q / -d;
    vec3 x, y;
    orthonormalBasis(axis, x, y);
    const float sine = std::sqrt(sine2);
    const vec3 w = cosine * axis + sine * (std::cos(phi) * x + std::sin(phi) * y);
    const float t = d * cosine - std::sqrt(std::max(0.0f, 1.0f - d2 * sine2));
    const vec3 p = glm::normalize(q + t * w);
    out.position = shape.origin + shape.axes * p;
    out.normal = glm::normalize(p * shape.inverse);
    out.pdf = spherePdf(shape, point, out.position);
    return out.pdf > 0.0f;
}

float spherePdf(const AreaShape& shape, const vec3& point, const vec3& position) {
    const vec3 q = shape.local(point);
    const float d2 = glm::dot(q, q);
    if (!(d2 > 1.0f)) return 0.0f;
    const float local = 1.0f / (2.0f * pi * coneHeight(d2));
    // d(local solid angle) = d(solid angle) |det inverse| / |inverse direction|^3
    const vec3 v = position - point;
    const float length = glm::length(v), localLength = glm::length(shape.inverse * v);
    const float ratio = length / localLength;
    return localLength > 0.0f ? local * ratio * ratio * ratio / shape.determinant : 0.0f;
}

bool sampleCylinder(const AreaShape& shape, const vec3& point, const vec2& u, ShapeSample& out) {
    CylinderView view;
    if (!viewCylinder(shape, point, view)) return false;
    const float psi = (2.0f * u.y - 1.0f) * view.half;
    const float sine = std::clamp(view.rho * std::sin(psi), -1.0f, 1.0f);
    const float phi = view.phi + std::asin(sine) - psi;
    const float turn = std::tan(u.x * view.angle);
    const float x = (view.a + turn) / (1.0f - view.a * turn);
    const float t = std::clamp(view.middle + x / view.scale, -0.5f, 0.5f);
    const vec3 p(0.0f, std::cos(phi), std::sin(phi));
    out.position = shape.origin + shape.axes * vec3(t, p.y, p.z);
    out.normal = glm::normalize(p * shape.inverse);
    out.pdf =
        areaToSolidAngle(cylinderAreaPdf(shape, view, t, phi), point, out.position, out.normal);
    return out.pdf > 0.0f && std::isfinite(out.pdf);
}

float cylinderPdf(const AreaShape& shape, const vec3& point, const vec3& position,
                  const vec3& normal) {
    CylinderView view;
    if (!viewCylinder(shape, point, view)) return 0.0f;
    const vec3 q = shape.local(position);
    const float pdf = cylinderAreaPdf(shape, view, q.x, std::atan2(q.z, q.y));
    return areaToSolidAngle(pdf, point, position, normal);
}

} // namespace patina
