// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/sphericalTriangle.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

using glm::dvec3;

namespace {
// Below, the triangle looks flat from here and area sampling is as good; above, the point all but
// lies in the triangle's plane.
constexpr double smallestAngle = 1e-3, largestAngle = 6.2;

/// The triangle as a spherical one around the point.
struct SphericalTriangle {
    dvec3 a, b, c;
    double alpha, cosC, solidAngle; ///< angle at a, cosine of the edge opposite to c
};

dvec3 orthogonal(const dvec3& v, const dvec3& to) {
    return v - glm::dot(v, to) * to;
}

double angleBetween(const dvec3& n, const dvec3& m) {
    return std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m));
}

bool project(const vec3 v[3], const vec3& point, SphericalTriangle& t) {
    const dvec3 p(point);
    const dvec3 a = dvec3(v[0]) - p, b = dvec3(v[1]) - p, c = dvec3(v[2]) - p;
    // Girard's excess by Van Oosterom and Strackee 1983.
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    if (!(la > 0.0 && lb > 0.0 && lc > 0.0)) return false;
    t.a = a / la;
    t.b = b / lb;
    t.c = c / lc;
    const double numerator = std::abs(glm::dot(t.a, glm::cross(t.b, t.c)));
    const double denominator = 1.0 + glm::dot(t.a, t.b) + glm::dot(t.b, t.c) + glm::dot(t.c, t.a);
    t.solidAngle = 2.0 * std::atan2(numerator, denominator);
    if (!(t.solidAngle > smallestAngle && t.solidAngle < largestAngle)) return false;
    t.alpha = angleBetween(glm::cross(t.a, t.b), glm::cross(t.a, t.c));
    t.cosC = glm::dot(t.a, t.b);
    return true;
}

struct Plane {
    vec3 normal;
    float area;
};

/// @returns false when nothing is emitted towards the point; the normal is turned to it
bool facing(const vec3 v[3], bool twoSided, const vec3& point, Plane& plane) {
    const vec3 n = glm::cross(v[1] - v[0], v[2] - v[0]);
    const float length = glm::length(n);
    if (!(length > 0.0f) || !std::isfinite(length)) return false;
    plane.area = 0.5f * length;
    plane.normal = n / length;
    const float side = glm::dot(point - v[0], plane.normal);
    if (side == 0.0f || (side < 0.0f && !twoSided)) return false;
    if (side < 0.0f) plane.normal = -plane.normal;
    return true;
}

float areaPdf(const Plane& plane, const vec3& point, const vec3& position) {
    const vec3 d = point - position;
    const float d2 = glm::dot(d, d), projected = glm::dot(d, plane.normal);
    return projected > 0.0f ? d2 * std::sqrt(d2) / (projected * plane.area) : 0.0f;
}

vec2 barycentrics(const vec3 v[3], const dvec3& position) {
    const dvec3 e1 = dvec3(v[1]) - dvec3(v[0]), e2 = dvec3(v[2]) - dvec3(v[0]);
    const dvec3 n = glm::cross(e1, e2), d = position - dvec3(v[0]);
    const double nn = glm::dot(n, n);
    double b1 = glm::dot(glm::cross(d, e2), n) / nn, b2 = glm::dot(glm::cross(e1, d), n) / nn;
    b1 = std::clamp(b1, 0.0, 1.0);
    b2 = std::clamp(b2, 0.0, 1.0 - b1);
    return vec2(b1, b2);
}

} // namespace

bool sampleTriangle(const vec3 v[3], bool twoSided, const vec3& point, const vec2& u,
                    TriangleSample& out) {
    Plane plane;
    if (!facing(v, twoSided, point, plane)) return false;
    out.normal = plane.normal;
    SphericalTriangle t;
    if (project(v, point, t)) {
        // The sub-triangle a, b, c' of area u.x times the whole, then a point between b and c'.
        const double area = double(u.x) * t.solidAngle;
        const double s = std::sin(area - t.alpha), c = std::cos(area - t.alpha);
        const double ca = std::cos(t.alpha), sa = std::sin(t.alpha);
        const double p = c - ca, q = s + sa * t.cosC;
        const double bottom = (q * s + p * c) * sa; // of cos b'
        double cosB = bottom != 0.0 ? ((q * c - p * s) * ca - q) / bottom : 1.0;
        cosB = std::clamp(cosB, -1.0, 1.0);
        const dvec3 towardC = glm::normalize(orthogonal(t.c, t.a));
        const dvec3 cut = cosB * t.a + std::sqrt(1.0 - cosB * cosB) * towardC;
        const double z = 1.0 - double(u.y) * (1.0 - glm::dot(cut, t.b));
        const dvec3 side = orthogonal(cut, t.b);
        const double sideLength = glm::length(side);
        const dvec3 w = sideLength > 0.0
                            ? z * t.b + std::sqrt(std::max(0.0, 1.0 - z * z)) * (side / sideLength)
                            : t.b;
        const double along = glm::dot(w, dvec3(plane.normal));
        if (along < 0.0) {
            const double distance =
                glm::dot(dvec3(v[0]) - dvec3(point), dvec3(plane.normal)) / along;
            out.barycentrics = barycentrics(v, dvec3(point) + distance * w);
            out.pdf = float(1.0 / t.solidAngle);
            out.position =
                v[0] + out.barycentrics.x * (v[1] - v[0]) + out.barycentrics.y * (v[2] - v[0]);
            return true;
        }
        return false;
    }
    // Square to triangle without folding (Heitz 2019).
    vec2 b = u;
    if (b.y > b.x) {
        b.x *= 0.5f;
        b.y -= b.x;
    } else {
        b.y *= 0.5f;
        b.x -= b.y;
    }
    out.barycentrics = b;
    out.position = v[0] + b.x * (v[1] - v[0]) + b.y * (v[2] - v[0]);
    out.pdf = areaPdf(plane, point, out.position);
    return out.pdf > 0.0f && std::isfinite(out.pdf);
}

float trianglePdf(const vec3 v[3], bool twoSided, const vec3& point, const vec3& position) {
    Plane plane;
    if (!facing(v, twoSided, point, plane)) return 0.0f;
    SphericalTriangle t;
    if (project(v, point, t)) return float(1.0 / t.solidAngle);
    return areaPdf(plane, point, position);
}

} // namespace patina
