// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/groupPlaces.h"
#include "hdDelegate/embree/surface.h"

namespace patina {

// Prims as shapes for rays: how finely they are drawn, and the surfaces that this gives.

using Programs = std::vector<std::shared_ptr<const MaterialProgram>>;

/// Finds how long the edges of tessellated prims may be.
class EdgeTargets {
public:
    /// @param screen outlives this
    EdgeTargets(const ScreenScale& screen, const TracedSpace& space, const GroupPlaces& places)
        : _screen(screen), _space(space), _places(places) {}

    /// In the prim's own space: so many pixels where it is nearest, rounded to a power of two so
    /// that small moves of the camera change nothing. 0: it is drawn as it is.
    float of(const Geometry& prim, const PrimExtent& extent, float pixels);
    /// The roundEdge of an implicit prim of the world, see TessellationOptions. 0: all segments.
    float round(const Implicit& prim) const;

private:
    const ScreenScale& _screen;
    const TracedSpace& _space;
    const GroupPlaces& _places;
    std::map<std::string, std::vector<mat4>> _transforms; ///< by group, of those asked for
};

/// A prim at rest, not placed yet.
/// @param displacers as displace() takes them
/// @param keepRest Surface::rest keeps all, so that a move is no new shape
std::shared_ptr<Surface> shapeSurface(const std::shared_ptr<const Geometry>& prim, float edge,
                                      const Programs& displacers, bool keepRest,
                                      const TracedSpace& space, CompiledShapes& shapes,
                                      Diagnostics& diagnostics);
/// One of many equal prims, in its place.
std::shared_ptr<Surface> shareSurface(const std::shared_ptr<const Geometry>& prim,
                                      const std::shared_ptr<const SharedShape>& shared,
                                      const TracedSpace& space, Diagnostics& diagnostics);
/// The same surface, to be placed anew.
std::shared_ptr<Surface> moveSurface(const Surface& surface,
                                     const std::shared_ptr<const Geometry>& prim,
                                     const TracedSpace& space);

} // namespace patina
