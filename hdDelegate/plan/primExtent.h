// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"

namespace patina {

/// The sizes of a prim that decide how finely it is drawn. Object space; points that are not finite
/// do not count, and those of the first sample stand for all.
struct PrimExtent {
    vec3 low{0.0f}, high{0.0f}; ///< curves and points: with their widths
    float area = 0.0f;          ///< of the faces of a mesh
    float across = 0.0f;        ///< of a mesh: diagonal of the box over the root of three
    /// Of a mesh: diameter of a ball that is as round: six times volume over area, at least an
    /// eighth of `across` (sheets have no volume) and at most that.
    float round = 0.0f;
    bool empty = true; ///< it has no points

    explicit PrimExtent(const Geometry& prim);

    vec3 center() const { return 0.5f * (low + high); }
    float radius() const { return 0.5f * glm::length(high - low); } ///< of the ball around the box

private:
    void around(const std::vector<vec3>& points);
    void measure(const Implicit& prim);
    void measure(const Mesh& mesh);
};

/// Whether a prim is drawn more or less finely: a mesh with a subdivision scheme.
bool subdivides(const Geometry& prim);

/// The largest factor by which a transform makes lengths along an axis longer.
float largestScale(const mat4& m);

/// How large things look: where the camera is and what a pixel of it covers.
struct ScreenScale {
    vec3 eye{0.0f};
    bool perspective = true;
    float pixelSpread = 0.0f; ///< angle of a pixel; its width when orthographic
    float nearest = 0.0f;     ///< distance that nothing is nearer than
    double pixels = 1.0;      ///< of the image

    /// Object units that a pixel covers of a ball, where that is nearest.
    /// @param toWorld from the space of the ball to that of the eye
    float unit(const mat4& toWorld, const vec3& center, float radius) const;
};

} // namespace patina
