// SPDX-License-Identifier: Apache-2.0
// Ids, positions and normals of what is seen, and what follows from where it is.

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/passes/rasterAovs.h"
#include "hdDelegate/raster/passes/rasterPassBlock.h"

#include "hdDelegate/film/aovValues.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>

namespace patina {

/// The targets of aovs.frag.glsl.
void RasterPasses::makeAovTarget(const RasterAovRequest& request) {
    const auto make = [&] { return GlTexture(GL_TEXTURE_2D, GL_RGBA32F, _width, _height); };
    _aovRequest = request;
    _albedo = request.albedo || !request.primvars.empty() ? make() : GlTexture();
    _primvars.clear();
    std::vector<const GlTexture*> targets = {&_position, &_normal, &_ids};
    if (_albedo) targets.push_back(&_albedo);
    for (size_t i = 0; i < request.primvars.size(); ++i)
        _primvars.push_back(make());
    for (const GlTexture& primvar : _primvars)
        targets.push_back(&primvar);
    _aovTarget = GlFramebuffer(targets, &_depth);
}

/// Whether an AOV is made of normals, which take time to read back.
static bool wantsNormals(const std::vector<AovSpec>& aovs) {
    return std::any_of(aovs.begin(), aovs.end(),
                       [](const AovSpec& aov) { return aovIsOfNormal(aov.id); });
}

void RasterPasses::drawAovs(const RasterScene& scene, const RasterCamera& camera,
                            const std::vector<AovSpec>& aovs) {
    if (!(scene.aovs() == _aovRequest)) makeAovTarget(scene.aovs());
    if (!_aovTarget.complete()) throw DeviceError("the driver has no room for the AOVs");
    const RasterView view =
        camera.view(vec2(0.0f), vec2(0.0f), 0.5f, scene.boundsMin(), scene.boundsMax());
    _timer.mark(Aovs);
    fillAovTarget(scene, view, block(scene, view));

    _timer.mark(ReadBack);
    const size_t pixels = size_t(_width) * size_t(_height);
    const auto read = [&](const GlTexture& from, std::vector<vec4>& to) {
        to.resize(pixels);
        _download.read(from, GL_RGBA, GL_FLOAT, pixels * sizeof(vec4), to.data());
    };
    read(_position, _seen.positions);
    if (wantsNormals(aovs)) read(_normal, _seen.normals);
    if (_albedo) read(_albedo, _seen.albedos);
    _seen.primvars.resize(_primvars.size());
    for (size_t i = 0; i < _primvars.size(); ++i)
        read(_primvars[i], _seen.primvars[i]);
    readIds(_seen.ids);
    _timer.collect(_seconds);
    measureReceivers(scene, camera, view);
}

void RasterPasses::readIds(std::vector<int>& ids) {
    ids.resize(4 * size_t(_width) * size_t(_height));
    _download.read(_ids, GL_RGBA_INTEGER, GL_INT, ids.size() * sizeof(int), ids.data());
}

void RasterPasses::fillAovTarget(const RasterScene& scene, const RasterView& view,
                                 const PassBlock& b) {
    _passBuffer.write(&b, sizeof b);
    _passBuffer.bindUniform(0);
    _albedoTable.bindStorage(7);
    _aovTarget.bind();
    gl.Viewport(0, 0, _width, _height);
    const float none[4] = {0, 0, 0, 0}, far = 1.0f;
    const GLint noIds[4] = {-1, -1, -1, -1};
    gl.ClearNamedFramebufferfv(_aovTarget.id(), GL_COLOR, 0, none);
    gl.ClearNamedFramebufferfv(_aovTarget.id(), GL_COLOR, 1, none);
    gl.ClearNamedFramebufferiv(_aovTarget.id(), GL_COLOR, 2, noIds);
    for (size_t i = 0; i < _primvars.size() + (_albedo ? 1 : 0); ++i)
        gl.ClearNamedFramebufferfv(_aovTarget.id(), GL_COLOR, 3 + GLint(i), none);
    gl.ClearNamedFramebufferfv(_aovTarget.id(), GL_DEPTH, 0, &far);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    gl.BindVertexArray(_vertexArray);
    {
        const Clipping clipping(view);
        drawSurfaces(scene, scene.visible(view.worldToClip), AllForAovs);
    }
}

void RasterPasses::drawMattes(const RasterScene& scene, const RasterMattes& mattes,
                              const RasterCamera& camera, const RasterSample& sample, uint32_t seed,
                              Film& film) {
    const RasterView view =
        camera.view(sample.beside, sample.lens, sample.time, scene.boundsMin(), scene.boundsMax());
    PassBlock b = block(scene, view);
    b.passIndex = int(sample.pass);
    b.passSeed = int(seed);
    _timer.mark(Aovs);
    fillAovTarget(scene, view, b);
    _timer.mark(ReadBack);
    std::vector<int> ids;
    readIds(ids);
    _timer.collect(_seconds);
    mattes.count(ids, _width, _height, _window, film);
}

void RasterPasses::writeAovs(const RasterScene& scene, const RasterCamera& camera,
                             const std::vector<AovSpec>& aovs, Film& film) const {
    const RasterAovs target{camera, aovs, scene.origin(), _width, _height, _window};
    target.write(_seen, _aovRequest, film);
}

/// The points that the camera sees: shadows are needed on these alone.
void RasterPasses::measureReceivers(const RasterScene& scene, const RasterCamera& camera,
                                    const RasterView& view) {
    vec3 low(INFINITY), high(-INFINITY), fibresLow = low, fibresHigh = high;
    std::set<int> fibres;
    for (const RasterDraw& d : scene.draws())
        if (d.flags & RasterShape::strip) fibres.insert(d.primId);
    std::mutex mutex;
    parallelFor(0, _height, [&](int y) {
        vec3 rowLow(INFINITY), rowHigh(-INFINITY), rowFibresLow = rowLow, rowFibresHigh = rowHigh;
        for (size_t i = size_t(y) * size_t(_width); i < size_t(y + 1) * size_t(_width); ++i) {
            const vec4& p = _seen.positions[i];
            if (!(p.w > 0.0f) || !std::isfinite(p.x + p.y + p.z)) continue;
            // Samples beside the pixel's centre, through the lens too.
            const float away = glm::length(vec3(p) - view.eye);
            const float beside =
                2.0f * (view.perspective ? away : 1.0f) * view.pixelSpread + camera.blurAt(away);
            rowLow = glm::min(rowLow, vec3(p) - beside);
            rowHigh = glm::max(rowHigh, vec3(p) + beside);
            if (fibres.count(_seen.ids[4 * i]) == 0) continue;
            rowFibresLow = glm::min(rowFibresLow, vec3(p) - beside);
            rowFibresHigh = glm::max(rowFibresHigh, vec3(p) + beside);
        }
        const std::lock_guard<std::mutex> lock(mutex);
        low = glm::min(low, rowLow);
        high = glm::max(high, rowHigh);
        fibresLow = glm::min(fibresLow, rowFibresLow);
        fibresHigh = glm::max(fibresHigh, rowFibresHigh);
    });
    _bounds.sceneMin = scene.boundsMin();
    _bounds.sceneMax = scene.boundsMax();
    if (low.x > high.x) {
        low = _bounds.sceneMin;
        high = _bounds.sceneMax;
    }
    _seenMin = low;
    _seenMax = high;
    const vec3 margin = 0.02f * (high - low) + 1e-4f * glm::length(high - low);
    _bounds.receiverMin = glm::max(low - margin, _bounds.sceneMin);
    _bounds.receiverMax = glm::min(high + margin, _bounds.sceneMax);
    // Texels of maps for all that is seen would be wider than fibres are apart.
    const bool closer = 2.0f * glm::length(fibresHigh - fibresLow) < glm::length(high - low);
    _bounds.fibresMin = closer ? fibresLow : vec3(1.0f);
    _bounds.fibresMax = closer ? fibresHigh : vec3(0.0f);
    _sky.reset();
}

vec3 RasterPasses::originOfSeen(const RasterScene& scene) const {
    const glm::dvec3 low(_seenMin), high(_seenMax), half = 0.5 * (high - low);
    const glm::dvec3 middle = glm::dvec3(scene.origin()) + 0.5 * (low + high);
    const double size = std::max({half.x, half.y, half.z});
    return vec3(originNear(middle, size, 16.0, 4.0));
}

} // namespace patina
