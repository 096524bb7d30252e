// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/subdivision.h"
#include "hdDelegate/raster/scene/rasterCamera.h"
#include "hdDelegate/raster/scene/rasterInstances.h"

namespace patina {

/// How finely a prim is drawn, by its size on screen.
class RasterDetail {
public:
    /// A chord of c pixels leaves a circle of R pixels by c^2 / 8R. The edges of a prim follow from
    /// that:
    /// - If the gap is less than `largestGap`, edges may be twice as long as the settings say,
    ///   since normals are smooth. Displaced prims are excepted.
    /// - If the settings ask for shorter edges than the default's, the gap shrinks with their
    ///   square.
    /// - Small round shapes have shorter edges instead, as always in the path tracer.
    /// - Prims that glow have a quarter of the gap: it shows against their edge.
    RasterDetail(const Geometry& prim, const PrimExtent& extent, const RasterCamera& camera,
                 const RenderSettings& settings, float edgeLength, bool displaced, bool glows);

    bool refines() const { return _edgeLength > 0.0f; } ///< else edgeAt() is 0 everywhere
    /// The longest edge, in object units, that looks as long from the camera as the settings ask
    /// for: a power of two, so that few of them differ. 0: the prim is not refined. Of curves and
    /// points the width of a pixel.
    float edgeAt(const RasterPlace& place) const;
    /// The most triangles that edges of so many object units are asked for: those whose own edges
    /// leave the surface by no more than `largestGap`. Uniform refinement by the longest edge alone
    /// would make most of a mesh needlessly fine.
    size_t trianglesFor(float edge) const;

    static constexpr float largestGap = 0.03f; ///< pixels
    /// Smaller images, of which outlines take a larger share, have as much smaller gaps, down to a
    /// quarter.
    static constexpr float gapPixels = 512.0f; ///< along the longer side

private:
    /// The longest chord, for `unit` object units a pixel.
    float chord(float unit) const;

    dmat4 _toGroup{1.0};
    vec3 _center{0.0f};
    float _gap = largestGap; ///< pixels
    float _radius = 0.0f, _area = 0.0f, _edgeLength = 0.0f;
    float _finest = 0.0f; ///< of round prims: their shortest edges, in object units
    bool _round = false;  ///< an implicit shape
    bool _slight = false; ///< curves or points, which only ask for the width of a pixel
    bool _displaced = false;
    ScreenScale _screen;
};

} // namespace patina
