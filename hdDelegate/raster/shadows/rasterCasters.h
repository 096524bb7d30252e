// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/scene/rasterScene.h"
#include "hdDelegate/raster/shadows/rasterSky.h"

#include <functional>

namespace patina {

/// Draws what casts shadows into the maps of lights and of the sky's cells. Lives with one context.
class RasterCasters {
public:
    /// @param vertexArray see RasterScene::describe()
    explicit RasterCasters(GLuint vertexArray) : _vertexArray(vertexArray) {}

    /// Cells of the sky that a pass draws: all of a small scene. A large one gets them by and by,
    /// and one whose casters let light pass, too, since their materials are evaluated for every
    /// texel. As many maps may be drawn for a preview.
    static int skyCells(const RasterScene& scene);
    /// Shadow maps of a pass, where pixels choose among all lights that have some: fewer where
    /// there is much to draw into each; a call takes as long as some hundred triangles. Volumes are
    /// lit by all lights of a pass, each of which takes long.
    static int mostMaps(const RasterScene& scene);

    /// Draws the maps of a pass. Needs its numbers, as the others do.
    void draw(const RasterScene& scene, const ShadowPlan& plan, uint32_t pass);
    void bind() const; ///< 5 of storage buffers, 18 and 25 of textures
    /// Draws cells of the sky and binds all of them: 10 of storage buffers, 19 of textures.
    void drawSky(const RasterScene& scene, const ShadowBounds& bounds, uint32_t seed,
                 uint32_t pass);
    /// Draws what the passes from `from` on have left of them for that of number `taken`.
    /// @param begin brings scene and numbers to a pass
    void resumeSky(const RasterScene& scene, const ShadowBounds& bounds, uint32_t seed,
                   uint32_t from, uint32_t taken, const std::function<void(uint32_t)>& begin);
    void forgetSky() { _sky.reset(); }

private:
    /// What each layer of an array of shadow maps shows. The first pass after a camera move, as a
    /// rule, finds what it needs.
    struct Shown {
        struct Layer {
            ShadowView view;
            uint32_t pass;    ///< random numbers of casters that let some light pass follow from it
            uint64_t version; ///< RasterScene::shadowVersion(); 0: nothing is known
        };
        GLuint maps = 0; ///< the array
        std::vector<Layer> layers;
    };
    /// Draws into a layer, unless that is what it shows.
    /// @param slopes null: only depths are wanted
    void draw(const RasterScene& scene, const ShadowView& view, uint32_t pass,
              const GlTexture& maps, int layer, Shown& shown, const GlTexture* slopes = nullptr);

    std::unique_ptr<GlProgram> _plain = GlProgram::own("shadow", "shadow");
    std::unique_ptr<GlProgram> _around =
        GlProgram::own("shadow", "shadow", "#define AROUND_LIGHT\n");
    GLuint _vertexArray;
    GlFramebuffer _target{{}, nullptr};
    GlBuffer _matrices;
    GlTexture _maps, _slopes;
    int _layers = 0;
    Shown _shown, _shownSky;
    RasterSky _sky;
};

} // namespace patina
