// SPDX-License-Identifier: Apache-2.0
// Casters of shadows, drawn into the maps of lights and of the sky's cells.

#include "hdDelegate/raster/passes/rasterDrawList.h"
#include "hdDelegate/raster/passes/rasterPasses.h"

#include <algorithm>

namespace patina {

void RasterPasses::drawShadows(const RasterScene& scene, const std::vector<ShadowView>& views,
                               int size, uint32_t pass) {
    const int layers = std::max(1, int(views.size()));
    if (layers > _shadowLayers || _shadowMaps.width() != size) {
        _shadowMaps = GlTexture(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, size, size, layers);
        _shadowSlopes = GlTexture(GL_TEXTURE_2D_ARRAY, GL_RG16F, size, size, layers);
        _shadowLayers = layers;
        _shownShadows = {};
        for (const GlTexture* maps : {&_shadowMaps, &_shadowSlopes}) {
            maps->parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST);
            maps->parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        }
    }
    for (size_t i = 0; i < views.size(); ++i)
        drawCasters(scene, views[i], pass, _shadowMaps, int(i), _shownShadows, &_shadowSlopes);
}

/// The first pass of a small scene draws all cells; a large one gets them by and by, and one whose
/// casters let light pass, too, since their materials are evaluated for every texel.
int RasterPasses::skyCells(const RasterScene& scene) {
    const auto& draws = scene.draws();
    const bool slow = std::any_of(draws.begin(), draws.end(), [](const RasterDraw& d) {
        return d.prim->visibility.shadow && d.material->programs->shadow;
    });
    const size_t triangles = std::max<size_t>(1, scene.trianglesDrawn());
    return int(std::clamp<size_t>(2000000 / triangles, 4, slow ? 24 : 1000));
}

/// Shadow maps of a pass, where pixels choose among all lights that have some: fewer where there is
/// much to draw into each; a call takes as long as some hundred triangles. Volumes are lit by all
/// lights of a pass, each of which takes long.
int RasterPasses::mostMaps(const RasterScene& scene) {
    if (!scene.volumes().empty()) return RasterLights::maxSmallMaps;
    const size_t each = std::max<size_t>(1, scene.trianglesDrawn() + 500 * scene.draws().size());
    return int(
        std::clamp<size_t>(10000000 / each, RasterLights::maxSmallMaps, RasterLights::maxManyMaps));
}

void RasterPasses::drawSky(const RasterScene& scene, const RasterLights& lights, uint32_t pass) {
    for (const RasterSky::Task& task : _sky.begin(pass, lights.seed(), _bounds, skyCells(scene)))
        drawCasters(scene, task.view, pass, _sky.maps(), task.layer, _shownSky);
}

void RasterPasses::drawCasters(const RasterScene& scene, const ShadowView& view, uint32_t pass,
                               const GlTexture& maps, int layer, ShownShadows& shown,
                               const GlTexture* slopes) {
    if (shown.maps != maps.id()) shown = {maps.id(), {}};
    if (shown.layers.size() <= size_t(layer)) shown.layers.resize(size_t(layer) + 1);
    ShownShadows::Layer& now = shown.layers[size_t(layer)];
    const uint64_t version = scene.moves() ? 0 : scene.shadowVersion();
    if (version != 0 && now.version == version && now.pass == pass && now.view == view) return;
    now = {view, pass, version};
    gl.BindFramebuffer(GL_FRAMEBUFFER, _shadowTarget);
    gl.Viewport(0, 0, maps.width(), maps.height());
    const GLenum color = slopes ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    gl.NamedFramebufferDrawBuffers(_shadowTarget, 1, &color);
    gl.NamedFramebufferTextureLayer(_shadowTarget, GL_COLOR_ATTACHMENT0, slopes ? slopes->id() : 0,
                                    0, slopes ? layer : 0);
    const float far = 1.0f;
    gl.NamedFramebufferTextureLayer(_shadowTarget, GL_DEPTH_ATTACHMENT, maps.id(), 0, layer);
    gl.ClearNamedFramebufferfv(_shadowTarget, GL_DEPTH, 0, &far);
    const vec4& to = view.towards;
    const RasterVisible visible = scene.visible(view.worldToMap, view.clampsNear);
    // Few lights have anything inside, and in few planes of emitters there is more than the
    // emitter.
    const RasterVisible inside =
        view.own != ShadowView::Nothing ? scene.visible(view.worldToLight) : RasterVisible();
    struct State {
        const GlProgram* program;
        const RasterMaterial* material; ///< null where only its shape counts
        bool around;
        size_t first;
    };
    RasterDrawList list;
    std::vector<State> states;
    bool evaluates = false;
    for (const RasterDraw& d : scene.draws()) {
        if (!d.prim->visibility.shadow || d.material->glsl.volumeOnly || !visible.shows(d))
            continue;
        const GlProgram* own = d.material->programs->shadow.get();
        const bool around = inside.shows(d);
        const State state{own      ? own
                          : around ? _shadowAround.get()
                                   : _shadow.get(),
                          own ? d.material : nullptr, around, list.size()};
        if (states.empty() || states.back().program != state.program ||
            states.back().material != state.material)
            states.push_back(state);
        evaluates |= own != nullptr;
        list.add(d, *d.casting, visible);
    }
    list.upload(evaluates);
    scene.bind(_vertexArray);
    if (view.clampsNear) gl.Enable(GL_DEPTH_CLAMP);
    const GlProgram* last = nullptr;
    for (size_t i = 0; i < states.size(); ++i) {
        const State& state = states[i];
        if (state.program != last) {
            state.program->use();
            gl.UniformMatrix4fv(2, 1, GL_FALSE, &view.worldToMap[0][0]);
            gl.Uniform1i(3, view.category);
            gl.Uniform4f(6, to.x, to.y, to.z, to.w);
            if (state.material || state.around) {
                gl.UniformMatrix4fv(11, 1, GL_FALSE, &view.worldToLight[0][0]);
                gl.Uniform1i(12, int(view.own));
            }
        }
        last = state.program;
        if (state.material) state.material->bind();
        list.draw(_vertexArray, state.first,
                  i + 1 < states.size() ? states[i + 1].first : list.size(),
                  state.material != nullptr);
    }
    gl.Disable(GL_DEPTH_CLAMP);
}

} // namespace patina
