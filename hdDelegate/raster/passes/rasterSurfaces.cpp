// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterSurfaces.h"

#include "hdDelegate/raster/scene/rasterDrawList.h"

#include <algorithm>
#include <unordered_map>

namespace patina {

void RasterSurfaces::begin(const RasterPassBlock& block) {
    _passBuffer.write(&block, sizeof block);
    _passBuffer.bindUniform(0);
    _albedoTable.bindStorage(7);
    gl.BindVertexArray(vertexArray());
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
}

namespace {

bool isDrawnByDepth(const RasterDraw& d) {
    return !d.material->glsl.presence && !d.material->glsl.volumeOnly &&
           !d.material->glsl.transmits && !d.culls();
}

/// What the driver is told before draws.
struct DrawState {
    const GlProgram* program = nullptr;
    const RasterMaterial* material = nullptr;
    vec4 glow{0.0f};
    int table = -1;     ///< of a mesh light
    bool known = false; ///< its depth is drawn already
    bool operator==(const DrawState& o) const {
        return program == o.program && material == o.material && glow == o.glow &&
               table == o.table && known == o.known;
    }
};

} // namespace

void RasterSurfaces::draw(const RasterScene& scene, const RasterVisible& visible, Which which,
                          const RasterLightFilters* filters) const {
    const std::vector<std::string>& primvars = scene.materials().aovs().primvars;
    const bool aovs = which == AllForAovs;
    // What the depth test sorts is drawn material by material.
    const bool sorts = aovs || which == Solid;
    std::vector<std::pair<size_t, const RasterDraw*>> shown;
    std::unordered_map<const RasterMaterial*, size_t> ranks; ///< by first draws, in view or not
    for (const RasterDraw& d : scene.draws()) {
        if (which == ColoredPresence ? !d.material->programs->tint
            : aovs                   ? d.material->glsl.volumeOnly
                                     : d.material->glsl.transmits != (which == Transmitting))
            continue;
        const size_t rank = sorts ? ranks.emplace(d.material, ranks.size()).first->second : 0;
        if (visible.shows(d)) shown.emplace_back(rank, &d);
    }
    if (sorts)
        std::stable_sort(shown.begin(), shown.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
    RasterDrawList list;
    std::vector<std::pair<DrawState, size_t>> states; ///< and the first draw of each
    for (const auto& [rank, draw] : shown) {
        const RasterDraw& d = *draw;
        const RasterPrograms& programs = *d.material->programs;
        DrawState state;
        state.program = (which == ColoredPresence ? programs.tint
                         : aovs                   ? programs.aovs
                                                  : programs.color)
                            .get();
        state.material = d.material;
        if (!aovs) {
            state.glow = vec4(d.meshLight.radiance, float(d.meshLight.mode));
            state.table = filters ? filters->tableOfMesh(d.meshLight.filtered) : -1;
        }
        state.known = which == Solid && isDrawnByDepth(d);
        if (states.empty() || !(states.back().first == state))
            states.emplace_back(state, list.size());
        list.add(d, *d.surface, visible);
    }
    list.upload(true);
    scene.bind(vertexArray());
    DrawState last;
    for (size_t i = 0; i < states.size(); ++i) {
        const auto& [state, first] = states[i];
        const bool fresh = state.program != last.program;
        if (fresh) state.program->use();
        if (state.material != last.material) {
            state.material->bind();
            if (aovs && !primvars.empty()) {
                int slots[RasterAovRequest::maxPrimvars] = {-1, -1, -1, -1};
                for (size_t p = 0; p < primvars.size(); ++p)
                    slots[p] = RasterAovRequest::slot(state.material->primvars, primvars[p]);
                gl.Uniform4i(8, slots[0], slots[1], slots[2], slots[3]);
            }
        }
        if (!aovs && (fresh || state.glow != last.glow))
            gl.Uniform4f(7, state.glow.x, state.glow.y, state.glow.z, state.glow.w);
        if (!aovs && (fresh || state.table != last.table)) gl.Uniform1i(13, state.table);
        if (state.known != last.known) gl.DepthFunc(state.known ? GL_LEQUAL : GL_LESS);
        last = state;
        list.draw(vertexArray(), first, i + 1 < states.size() ? states[i + 1].second : list.size(),
                  true);
        const RasterPrograms& programs = *state.material->programs;
        if (!aovs && which != ColoredPresence && !programs.drawn) {
            programs.drawn = true;
            if (firstDraws) firstDraws();
        }
    }
    if (last.known) gl.DepthFunc(GL_LESS);
}

void RasterSurfaces::drawDepths(const RasterScene& scene, const RasterVisible& visible) const {
    RasterDrawList list;
    for (const RasterDraw& d : scene.draws())
        if (isDrawnByDepth(d)) list.add(d, *d.surface, visible);
    if (list.empty()) return;
    list.upload(false);
    scene.bind(vertexArray());
    _depthOnly->use();
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    list.draw(vertexArray(), 0, list.size(), false);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

} // namespace patina
