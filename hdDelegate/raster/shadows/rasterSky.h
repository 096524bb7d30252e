// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/shadows/rasterShadows.h"

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace patina {

#define PATINA_STRUCT SkyRows
#define PATINA_FIELDS "shaders/raster/skyFields.glsl"
#include "shaders/gpuStruct.inc"

/// Visibility of the sky in directions that are no light's samples: small shadow maps, one for each
/// cell of an octahedral grid of directions. Passes redraw some of them from other directions of
/// their cells, so the edges of shadows blur instead of standing still.
class RasterSky {
public:
    static constexpr int side = 12; ///< cells
    static constexpr int mapSize = 512;

    /// A map that has to be drawn.
    struct Task {
        int layer = 0;
        ShadowView view;
    };

    /// Forgets all maps.
    void reset() { _drawn.clear(); }
    /// Chooses the cells that a pass draws, at most `maximum` (at least 1; the first pass twice as
    /// many).
    std::vector<Task> begin(uint32_t pass, uint32_t seed, const ShadowBounds& bounds, int maximum);
    /// Binds maps and cells; cells that have no map yet borrow the nearest one.
    void bind(GLuint buffer, GLuint texture);

    const GlTexture& maps();

private:
    std::vector<SkyRows> _drawn; ///< all cells, layer -1 where nothing was drawn
    GlTexture _maps;
    int _layers = 0;      ///< of _maps
    bool _fibres = false; ///< maps for fibres lie behind the others
    GlBuffer _buffer;
};

} // namespace patina
