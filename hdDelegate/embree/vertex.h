// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/media/mediumStack.h"
#include "hdDelegate/embree/surface.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

/// The normal on the side that a surface is seen from.
inline vec3 facingNormal(const ShadingPoint& s) {
    return glm::dot(s.viewDirection, s.geometricNormal) < 0.0f ? -s.normal : s.normal;
}

/// Whether a direction leaves a surface on the side that it is seen from.
inline bool staysOutside(const SurfacePoint& point, const vec3& direction) {
    const vec3& n = point.shading.geometricNormal;
    return (glm::dot(point.shading.viewDirection, n) < 0.0f) == (glm::dot(direction, n) < 0.0f);
}

/// The lobes of a vertex of a path.
inline void setUpLobes(const SurfacePoint& point, Bsdf& bsdf) {
    const MaterialProgram& program = *point.slot->program;
    program.evaluate(point.shading, bsdf);
    if (program.hasSubsurface()) bsdf.walkSubsurface();
}

/// Sees a surface among overlapping objects: what it borders on, or that a medium of a higher
/// priority hides it. Then the media are those behind it.
inline bool isThere(MediumStack& media, SurfacePoint& point, const Hit& hit) {
    const MaterialProgram& program = *point.slot->program;
    ShadingPoint& s = point.shading;
    const int priority = program.encloses() ? dielectricPriorityOf(hit) : 0;
    s.surroundingIor = media.iorAround(program, s, priority);
    if (priority == 0 || !media.hides(program, s, priority)) return true;
    s.surroundingIor = 1.0f;
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    media.cross(program, s, priority, bsdf.ior());
    return false;
}

inline float powerHeuristic(float a, float b) {
    if (!std::isfinite(a)) return 1.0f;
    if (std::max(a, b) > 1e18f) { // squares would overflow
        const float ratio = b / a;
        return a > 0.0f ? 1.0f / (1.0f + ratio * ratio) : 0.0f;
    }
    const float aa = a * a, bb = b * b;
    return aa > 0.0f ? aa / (aa + bb) : 0.0f;
}

/// Weight of a sample of density a beside another strategy of density b. The power heuristic is for
/// lights that one strategy finds far better than the other. Both find a sky about as well, and
/// then the balance heuristic has less variance.
inline float misWeight(float a, float b, bool dome) {
    if (!dome) return powerHeuristic(a, b);
    if (!std::isfinite(a)) return 1.0f;
    return a > 0.0f ? a / (a + b) : 0.0f;
}

} // namespace patina
