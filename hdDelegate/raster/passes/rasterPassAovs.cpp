// SPDX-License-Identifier: Apache-2.0
// Ids, positions and normals of what is seen, and what follows from where it is.

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/passes/rasterAovs.h"
#include "hdDelegate/raster/passes/rasterPassBlock.h"

#include "hdDelegate/film/aovValues.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

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
    _aovsComplete = _aovTarget.complete();
}

/// Whether an AOV is made of normals, which take time to read back.
static bool wantsNormals(const std::vector<AovSpec>& aovs) {
    return std::any_of(aovs.begin(), aovs.end(),
                       [](const AovSpec& aov) { return aovIsOfNormal(aov.id); });
}

void RasterPasses::drawAovs(const RasterScene& scene, const RasterCamera& camera, bool inSteps) {
    if (!(scene.aovs() == _aovRequest)) makeAovTarget(scene.aovs());
    if (!_aovsComplete) throw DeviceError("the driver has no room for the AOVs");
    const RasterView view =
        camera.view(vec2(0.0f), vec2(0.0f), 0.5f, scene.boundsMin(), scene.boundsMax());
    _timer.mark(Aovs);
    fillAovTarget(scene, view, block(scene, view));
    measureReceivers(scene, camera, inSteps);
    _timer.collect(_seconds);
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

void RasterPasses::writeAovs(const RasterScene& scene, const RasterCamera& camera, Film& film) {
    std::vector<AovSpec> aovs = film.aovs(); // by place
    bool any = false;
    for (AovSpec& aov : aovs) {
        if (film.source() && film.source()->has(aov.id)) aov.id = AovId::unknown;
        any |= aov.id != AovId::unknown;
    }
    if (!any) return;
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
    const RasterAovs target{camera, aovs, scene.origin(), _width, _height, _window};
    target.write(_seen, _aovRequest, film);
}

/// The points that the camera sees: shadows are needed on these alone. After fillAovTarget().
void RasterPasses::measureReceivers(const RasterScene& scene, const RasterCamera& camera,
                                    bool inSteps) {
    uint32_t found[12];
    for (int i = 0; i < 12; ++i)
        found[i] = i / 3 % 2 == 0 ? ~0u : 0u;
    const GlBuffer bounds(sizeof found, found);
    bounds.bindStorage(6);
    _position.bind(0);
    _receivers->use();
    gl.Uniform2f(0, camera.frame().lensRadius > 0.0f ? camera.blurAt(0.0f) : 0.0f,
                 camera.camera().focusDistance);
    constexpr int side = 32; // pixels of a group
    gl.DispatchCompute(GLuint((_width + side - 1) / side), GLuint((_height + side - 1) / side), 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    bounds.read(found, sizeof found);
    const auto box = [&](int at) {
        vec3 corner;
        for (int i = 0; i < 3; ++i) {
            const uint32_t bits = found[at + i];
            corner[i] = glm::uintBitsToFloat((bits >> 31) != 0 ? bits & 0x7fffffffu : ~bits);
        }
        return corner;
    };
    _bounds.sceneMin = scene.boundsMin();
    _bounds.sceneMax = scene.boundsMax();
    const bool any = found[0] <= found[3], fibres = found[6] <= found[9];
    const vec3 low = any ? box(0) : _bounds.sceneMin, high = any ? box(3) : _bounds.sceneMax;
    _seenMin = low;
    _seenMax = high;
    const vec3 margin = 0.02f * (high - low) + 1e-4f * glm::length(high - low);
    // Small moves of the camera seldom cross a step.
    const auto widen = [&](vec3& from, vec3& to) {
        const vec3 size = to - from;
        const float largest = std::max({size.x, size.y, size.z});
        if (!inSteps || !(largest > 0.0f)) return;
        const float step = std::exp2(std::floor(std::log2(largest)) - 3.0f);
        from = glm::floor(from / step) * step;
        to = glm::ceil(to / step) * step;
    };
    vec3 receiverMin = low - margin, receiverMax = high + margin;
    widen(receiverMin, receiverMax);
    _bounds.receiverMin = glm::max(receiverMin, _bounds.sceneMin);
    _bounds.receiverMax = glm::min(receiverMax, _bounds.sceneMax);
    // Texels of maps for all that is seen would be wider than fibres are apart.
    const bool closer = fibres && 2.0f * glm::length(box(9) - box(6)) < glm::length(high - low);
    _bounds.fibresMin = closer ? box(6) : vec3(1.0f);
    _bounds.fibresMax = closer ? box(9) : vec3(0.0f);
    if (closer) widen(_bounds.fibresMin, _bounds.fibresMax);
    _sky.reset();
}

vec3 RasterPasses::originOfSeen(const RasterScene& scene) const {
    const glm::dvec3 low(_seenMin), high(_seenMax), half = 0.5 * (high - low);
    const glm::dvec3 middle = glm::dvec3(scene.origin()) + 0.5 * (low + high);
    const double size = std::max({half.x, half.y, half.z});
    return vec3(originNear(middle, size, 16.0, 4.0));
}

} // namespace patina
