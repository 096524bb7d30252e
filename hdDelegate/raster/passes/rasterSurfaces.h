// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/gl/glTimer.h"
#include "hdDelegate/raster/lights/rasterLightFilters.h"
#include "hdDelegate/raster/passes/rasterPassBlock.h"
#include "shaders/shaders.h"

#include <functional>

namespace patina {

/// Draws the surfaces of a scene, for all passes, and holds what these share. Lives with one
/// context.
class RasterSurfaces {
public:
    RasterSurfaces() { RasterScene::describe(vertexArray()); }
    GLuint vertexArray() const { return _vertexArray.id(); }

    /// Begins to draw with the numbers of a pass: the nearest is what shows.
    void begin(const RasterPassBlock& block);
    enum Which { AllForAovs, Solid, Transmitting, ColoredPresence };
    /// @param filters of mesh lights; null where nothing is lit
    void draw(const RasterScene& scene, const RasterVisible& visible, Which which,
              const RasterLightFilters* filters = nullptr) const;
    /// Depths of what is solid: only what is in front has to be shaded, which takes far longer than
    /// to find it.
    void drawDepths(const RasterScene& scene, const RasterVisible& visible) const;

    std::function<void()> firstDraws; ///< called when a program is drawn with for the first time
    GlDownload download;
    GlTimer timer;

private:
    std::unique_ptr<GlProgram> _depthOnly =
        GlProgram::own({{GL_VERTEX_SHADER, "surface",
                         "#define PRIMVARS 0\n#define DEPTH_ONLY\n"
                         "#include \"shaders/raster/surface.vert.glsl\"\n"},
                        {GL_FRAGMENT_SHADER, "shadow", "void main() {}\n"}});
    GlBuffer _passBuffer{sizeof(RasterPassBlock), nullptr};
    GlBuffer _albedoTable{sh::ALBEDO_TABLE_SIZE * sizeof(float), patinaAlbedoTable};
    GlVertexArray _vertexArray;
};

} // namespace patina
