#include "materialNetwork/cpu/shadingFrame.h"

#include <cmath>

namespace patina {

namespace {

// Sine of the smallest angle that the mirror direction keeps from the surface.
constexpr float margin = 1e-3f;

bool usable(float length) {
    return length > 1e-12f && std::isfinite(length);
}

/// Any unit vector orthogonal to n (Duff et al. 2017).
glm::vec3 anyTangent(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

} // namespace

glm::vec3 bendNormal(glm::vec3 n, const glm::vec3& v, const glm::vec3& g) {
    float nv = glm::dot(n, v);
    if (nv <= 0.0f) {
        const glm::vec3 turned = n + v * (margin - nv);
        const float length = glm::length(turned);
        n = usable(length) ? turned / length : g;
        nv = usable(length) ? margin / length : glm::dot(n, v);
    }
    const glm::vec3 mirror = n * (2.0f * nv) - v;
    const float above = glm::dot(mirror, g);
    // Near grazing even the geometric normal's own mirror direction lies below the margin.
    const float wanted = std::min(margin, glm::dot(v, g));
    if (above >= wanted) return n;
    // Half way from v to the mirror direction lifted by `lift`. At grazing angles the two are
    // nearly opposite, so that their sum holds few digits: it is put together from what is left of
    // it.
    const float lift = wanted - above;
    const float length = glm::length(mirror + g * lift);
    if (!usable(length)) return g;
    const float longer = lift * (2.0f * above + lift) / (length + 1.0f); // length - 1
    const glm::vec3 half = n * (2.0f * nv) + g * lift + v * longer;
    const float halfLength = glm::length(half);
    return usable(halfLength) ? half / halfLength : g;
}

BsdfFrame makeFrame(const ShadingPoint& point, const glm::vec3* normal, const glm::vec3* tangent,
                    bool flips) {
    const glm::vec3& v = point.viewDirection;
    const float side = glm::dot(v, point.geometricNormal) >= 0.0f ? 1.0f : -1.0f;
    glm::vec3 n = point.normal;
    if (normal) {
        const float length = glm::length(*normal);
        if (usable(length)) n = *normal / length;
    }
    BsdfFrame frame;
    const glm::vec3 facing = bendNormal(n * side, v, point.geometricNormal * side);
    frame.normal = flips ? facing : facing * side;
    glm::vec3 t = point.tangent;
    if (tangent && usable(glm::length(*tangent))) t = *tangent;
    t -= frame.normal * glm::dot(frame.normal, t);
    const float length = glm::length(t);
    frame.tangent = length > 1e-6f && std::isfinite(length) ? t / length : anyTangent(frame.normal);
    frame.bitangent = glm::cross(frame.normal, frame.tangent);
    frame.wo = frame.toLocal(v);
    return frame;
}

} // namespace patina
