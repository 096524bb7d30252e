// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/shadows/rasterCasters.h"

#include "hdDelegate/raster/scene/rasterDrawList.h"

#include <algorithm>
#include <map>

namespace patina {

int RasterCasters::skyCells(const RasterScene& scene) {
    const auto& draws = scene.draws();
    const bool slow = std::any_of(draws.begin(), draws.end(), [](const RasterDraw& d) {
        return d.prim->visibility.shadow && d.material->programs->shadow;
    });
    const size_t triangles = std::max<size_t>(1, scene.trianglesDrawn());
    return int(std::clamp<size_t>(2000000 / triangles, 4, slow ? 24 : 1000));
}

int RasterCasters::mostMaps(const RasterScene& scene) {
    if (!scene.volumes().empty()) return ShadowPlan::maxSmallMaps;
    const size_t each = std::max<size_t>(1, scene.trianglesDrawn() + 500 * scene.draws().size());
    return int(
        std::clamp<size_t>(10000000 / each, ShadowPlan::maxSmallMaps, ShadowPlan::maxManyMaps));
}

void RasterCasters::draw(const RasterScene& scene, const ShadowPlan& plan, uint32_t pass) {
    const int layers = std::max(1, int(plan.views.size())), size = plan.mapSize;
    if (layers > _layers || _maps.width() != size) {
        _maps = GlTexture(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, size, size, layers);
        _slopes = GlTexture(GL_TEXTURE_2D_ARRAY, GL_RG16F, size, size, layers);
        _layers = layers;
        _shown = {};
        for (const GlTexture* maps : {&_maps, &_slopes})
            maps->filter(GL_NEAREST);
    }
    std::vector<mat4> matrices;
    for (const ShadowView& view : plan.views) {
        draw(scene, view, pass, _maps, int(matrices.size()), _shown, &_slopes);
        matrices.push_back(view.worldToMap);
    }
    _matrices = GlBuffer(matrices);
}

void RasterCasters::bind() const {
    _matrices.bindStorage(5);
    _maps.bind(18);
    _slopes.bind(25);
}

void RasterCasters::drawSky(const RasterScene& scene, const ShadowBounds& bounds, uint32_t seed,
                            uint32_t pass) {
    for (const RasterSky::Task& task : _sky.begin(pass, seed, bounds, skyCells(scene)))
        draw(scene, task.view, pass, _sky.maps(), task.layer, _shownSky);
    _sky.bind(10, 19);
}

void RasterCasters::resumeSky(const RasterScene& scene, const ShadowBounds& bounds, uint32_t seed,
                              uint32_t from, uint32_t taken,
                              const std::function<void(uint32_t)>& begin) {
    std::map<int, std::pair<uint32_t, RasterSky::Task>> last; // by cell
    for (uint32_t pass = from; pass < taken; ++pass)
        for (const RasterSky::Task& task : _sky.begin(pass, seed, bounds, skyCells(scene)))
            last[task.layer] = {pass, task};
    for (const auto& [layer, drawn] : last) {
        begin(drawn.first);
        draw(scene, drawn.second.view, drawn.first, _sky.maps(), layer, _shownSky);
    }
}

void RasterCasters::draw(const RasterScene& scene, const ShadowView& view, uint32_t pass,
                         const GlTexture& maps, int layer, Shown& shown, const GlTexture* slopes) {
    if (shown.maps != maps.id()) shown = {maps.id(), {}};
    if (shown.layers.size() <= size_t(layer)) shown.layers.resize(size_t(layer) + 1);
    Shown::Layer& now = shown.layers[size_t(layer)];
    const uint64_t version = scene.moves() ? 0 : scene.shadowVersion();
    if (version != 0 && now.version == version && now.pass == pass && now.view == view) return;
    now = {view, pass, version};
    _target.bind();
    gl.Viewport(0, 0, maps.width(), maps.height());
    const GLenum color = slopes ? GL_COLOR_ATTACHMENT0 : GL_NONE;
    gl.NamedFramebufferDrawBuffers(_target.id(), 1, &color);
    gl.NamedFramebufferTextureLayer(_target.id(), GL_COLOR_ATTACHMENT0, slopes ? slopes->id() : 0,
                                    0, slopes ? layer : 0);
    const float far = 1.0f;
    gl.NamedFramebufferTextureLayer(_target.id(), GL_DEPTH_ATTACHMENT, maps.id(), 0, layer);
    gl.ClearNamedFramebufferfv(_target.id(), GL_DEPTH, 0, &far);
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
                          : around ? _around.get()
                                   : _plain.get(),
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
