// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterSeen.h"

#include "hdDelegate/film/aovValues.h"
#include "hdDelegate/parallel.h"
#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/passes/rasterMotion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace patina {

namespace {

/// For aovValue(): one pixel of the images.
struct PixelPoint {
    static constexpr bool denoisingOfPaths = false;

    const RasterSeenImages& images;
    const RasterCamera& camera;
    const RasterMotion& moving;
    const vec3& origin; ///< of positions
    int slot;           ///< of the primvar that is asked for, -1 where it was not drawn
    size_t i;

    vec3 inCamera() const {
        return vec3(camera.worldToCamera() * vec4(vec3(images.positions[i]), 1.0f));
    }
    float depth() const { return -inCamera().z; }
    float windowDepth() const { return camera.windowDepth(inCamera()); }
    vec3 position() const { return origin + vec3(images.positions[i]); }
    vec3 normal() const { return vec3(images.normals[i]); }
    vec3 geometricNormal() const { return vec3(images.geometricNormals[i]); }
    const mat4& worldToCamera() const { return camera.worldToCamera(); }
    int primId() const { return images.ids[4 * i]; }
    int instanceId() const { return images.ids[4 * i + 1]; }
    int elementId() const { return images.ids[4 * i + 2]; }
    bool albedo(float out[4]) const {
        return !images.albedos.empty() && put(images.albedos[i], out);
    }
    bool primvar(float out[4]) const {
        if (slot < 0) return false;
        const vec4& value = images.primvars[size_t(slot)][i];
        return put(value.w < 0.0f ? vec4(0.0f) : value, out); // see aovs.frag.glsl
    }
    bool reference(float out[4]) const {
        return slot >= 0 && put(images.primvars[size_t(slot)][i], out);
    }
    bool motion(bool later, float out[4]) const {
        return moving.way(&images.ids[4 * i], vec3(images.positions[i]),
                          later ? ScreenMotion::After : ScreenMotion::Before, out);
    }

private:
    static bool put(const vec4& v, float out[4]) {
        out[0] = v.x, out[1] = v.y, out[2] = v.z, out[3] = v.w;
        return true;
    }
};

} // namespace

bool RasterSeen::resize(int width, int height, const GlTexture& depth) {
    const auto make = [&](GLenum format) {
        return GlTexture(GL_TEXTURE_2D, format, width, height);
    };
    _position = make(GL_RGBA32F);
    _normal = make(GL_RGBA32F);
    _ids = make(GL_RGBA32I);
    _ids.filter(GL_NEAREST); // others do not read integers
    _width = width;
    _height = height;
    _depth = &depth;
    makeTarget(_request);
    return _complete;
}

/// The targets of aovs.frag.glsl.
void RasterSeen::makeTarget(const RasterAovRequest& request) {
    const auto make = [&] { return GlTexture(GL_TEXTURE_2D, GL_RGBA32F, _width, _height); };
    _request = request;
    const bool further = !request.primvars.empty() || request.geometricNormal;
    _albedo = request.albedo || further ? make() : GlTexture(); // they count on from there
    _primvars.clear();
    std::vector<const GlTexture*> targets = {&_position, &_normal, &_ids};
    if (_albedo) targets.push_back(&_albedo);
    for (size_t i = 0; i < request.primvars.size(); ++i)
        _primvars.push_back(make());
    for (const GlTexture& primvar : _primvars)
        targets.push_back(&primvar);
    _geometricNormal = request.geometricNormal ? make() : GlTexture();
    if (_geometricNormal) targets.push_back(&_geometricNormal);
    _target = GlFramebuffer(targets, _depth);
    _splatTarget = GlFramebuffer(targets, nullptr);
    _others = int(targets.size()) - 3;
    _complete = _target.complete();
}

/// Whether an AOV is made of normals, which take time to read back.
static bool wantsNormals(const std::vector<AovSpec>& aovs) {
    return std::any_of(aovs.begin(), aovs.end(),
                       [](const AovSpec& aov) { return aovIsOfNormal(aov.id); });
}

void RasterSeen::draw(const RasterScene& scene, const RasterCamera& camera, bool inSteps) {
    if (!(scene.materials().aovs() == _request)) makeTarget(scene.materials().aovs());
    if (!_complete) throw DeviceError("the driver has no room for the AOVs");
    const RasterView view =
        camera.view(vec2(0.0f), vec2(0.0f), 0.5f, scene.seenMin(), scene.seenMax());
    _surfaces.timer.mark(GlTimer::Aovs);
    fillTarget(scene, view, RasterPassBlock(scene, view));
    measureReceivers(scene, camera, inSteps);
    drawSplats(scene, view);
    _surfaces.timer.collect();
}

void RasterSeen::readIds(std::vector<int>& ids) {
    ids.resize(4 * size_t(_width) * size_t(_height));
    _surfaces.download.read(_ids, GL_RGBA_INTEGER, GL_INT, ids.size() * sizeof(int), ids.data());
}

void RasterSeen::fillTarget(const RasterScene& scene, const RasterView& view,
                            const RasterPassBlock& block) {
    _surfaces.begin(block);
    _target.bind();
    gl.Viewport(0, 0, _width, _height);
    const float none[4] = {0, 0, 0, 0}, far = 1.0f;
    const GLint noIds[4] = {-1, -1, -1, -1};
    gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, 0, none);
    gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, 1, none);
    gl.ClearNamedFramebufferiv(_target.id(), GL_COLOR, 2, noIds);
    for (GLint i = 0; i < _others; ++i)
        gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, 3 + i, none);
    gl.ClearNamedFramebufferfv(_target.id(), GL_DEPTH, 0, &far);
    const RasterClipping clipping(block);
    _surfaces.draw(scene, scene.visible(view.worldToClip), RasterSurfaces::AllForAovs);
}

/// Over what is drawn: after fillTarget(), with the numbers of its pass.
void RasterSeen::drawSplats(const RasterScene& scene, const RasterView& view) {
    if (scene.splats().empty()) return;
    _splatting.sort(scene.splats(), view, _width, _height);
    _splatTarget.bind();
    _splatting.drawAovs(scene.splats(), *_depth, _others);
}

void RasterSeen::count(const RasterScene& scene, const RasterMattes& mattes,
                       const RasterCamera& camera, const RasterSample& sample, uint32_t seed,
                       const int* window, Film& film) {
    const RasterView view =
        camera.view(sample.beside, sample.lens, sample.time, scene.seenMin(), scene.seenMax());
    RasterPassBlock b(scene, view);
    b.passIndex = int(sample.pass);
    b.passSeed = int(seed);
    _surfaces.timer.mark(GlTimer::Aovs);
    fillTarget(scene, view, b);
    drawSplats(scene, view);
    _surfaces.timer.mark(GlTimer::ReadBack);
    std::vector<int> ids;
    readIds(ids);
    _surfaces.timer.collect();
    mattes.count(ids, _width, _height, window, film);
}

void RasterSeen::write(const RasterScene& scene, const RasterCamera& camera, const int* window,
                       Film& film) {
    std::vector<AovSpec> aovs = film.aovs(); // by place
    bool any = false;
    for (AovSpec& aov : aovs) {
        if (film.source() && film.source()->has(aov.id)) aov.id = AovId::unknown;
        any |= aov.id != AovId::unknown;
    }
    if (!any) return;
    _surfaces.timer.mark(GlTimer::ReadBack);
    GlDownload& download = _surfaces.download;
    download.read(_position, _images.positions);
    if (wantsNormals(aovs)) download.read(_normal, _images.normals);
    if (_albedo) download.read(_albedo, _images.albedos);
    if (_geometricNormal) download.read(_geometricNormal, _images.geometricNormals);
    _images.primvars.resize(_primvars.size());
    for (size_t i = 0; i < _primvars.size(); ++i)
        download.read(_primvars[i], _images.primvars[i]);
    readIds(_images.ids);
    _surfaces.timer.collect();
    const RasterMotion moving(scene, camera, aovs);
    for (size_t a = 0; a < aovs.size(); ++a) {
        if (aovs[a].id == AovId::unknown) continue;
        const int slot = RasterAovRequest::slot(_request.primvars, aovs[a].primvar);
        parallelFor(window[1], std::max(window[1], window[3] + 1), [&](int y) {
            for (int x = window[0]; x <= window[2]; ++x) {
                const size_t i = size_t(_height - 1 - y) * size_t(_width) + size_t(x);
                if (_images.positions[i].w == 0.0f) continue;
                float out[4] = {0, 0, 0, 0};
                if (aovValue(aovs[a].id,
                             PixelPoint{_images, camera, moving, scene.origin(), slot, i}, out))
                    film.addAov(int(a), x, y, out, 0.0f);
            }
        });
    }
}

/// The points that the camera sees: shadows are needed on these alone. After fillTarget().
void RasterSeen::measureReceivers(const RasterScene& scene, const RasterCamera& camera,
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
    const vec3 low = any ? box(0) : scene.seenMin(), high = any ? box(3) : scene.seenMax();
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
}

vec3 RasterSeen::originOf(const RasterScene& scene) const {
    const glm::dvec3 low(_seenMin), high(_seenMax), half = 0.5 * (high - low);
    const glm::dvec3 middle = glm::dvec3(scene.origin()) + 0.5 * (low + high);
    const double size = std::max({half.x, half.y, half.z});
    return vec3(originNear(middle, size, 16.0, 4.0));
}

} // namespace patina
