// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterPasses.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/scene/rasterDrawList.h"

#include <algorithm>

namespace patina {

bool RasterPasses::resize(const RenderSettings& settings, int& border) {
    const int width = settings.width, height = settings.height;
    const PixelWindow& crop = settings.dataWindow;
    const bool all = crop[2] < crop[0] || crop[3] < crop[1];
    _window[0] = all ? 0 : std::clamp(crop[0], 0, width);
    _window[1] = all ? 0 : std::clamp(crop[1], 0, height);
    _window[2] = all ? width - 1 : std::min(crop[2], width - 1);
    _window[3] = all ? height - 1 : std::min(crop[3], height - 1);
    if (width > _largest || height > _largest) return false;
    if (std::max(width, height) + 2 * border > _largest) border = 0;
    if (width == _width && height == _height && border == _border) return true;
    const int across = width + 2 * border, up = height + 2 * border;
    _color = GlTexture(GL_TEXTURE_2D, GL_RGBA32F, across, up);
    _depth = GlTexture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, across, up);
    _colorTarget = GlFramebuffer({&_color}, &_depth);
    _pictureTarget = GlFramebuffer({&_color}, nullptr);
    _width = width;
    _height = height;
    _border = border;
    return _seen.resize(width, height, _depth) && _colorTarget.complete() &&
           _preview.resize(_color, _depth);
}

const FilmSource& RasterPasses::beginImage(const GlContext& context,
                                           const std::shared_ptr<HostContext>& host,
                                           const RasterCamera& camera) {
    if (!_image) _image = std::make_unique<RasterImage>(context, host);
    if (!_image->begin(_width, _height, _window, camera, _seen.positions(), _seen.ids()))
        throw DeviceError("the driver has no room for an image of this size");
    return *_image;
}

void RasterPasses::resumeAt(const RasterScene& scene, const RasterLights& lights, uint32_t from,
                            uint32_t taken, const std::function<void(uint32_t)>& moveTo) {
    if (!lights.needsSky()) return;
    _casters.resumeSky(scene, _seen.bounds(), lights.seed(), from, taken, [&](uint32_t pass) {
        moveTo(pass);
        RasterPassBlock b(scene);
        b.passIndex = int(pass);
        b.passSeed = int(lights.seed());
        _surfaces.begin(b);
    });
}

void RasterPasses::needRefraction() {
    if (!_refraction) _refraction = std::make_unique<RasterRefraction>();
    if (!_refraction->resize(_color.width(), _color.height()))
        throw DeviceError("the driver has no room for an image of this size");
}

void RasterPasses::drawVolumes(const RasterScene& scene) {
    if (scene.volumes().empty()) return;
    needRefraction();
    gl.Disable(GL_DEPTH_TEST);
    int index = 0;
    for (const RasterVolume* volume : scene.volumes()) {
        _refraction->keep(_color, _depth);
        _refraction->bind();
        _refraction->drawVolume(*volume, index++);
    }
    gl.Enable(GL_DEPTH_TEST);
}

/// Over what is drawn already.
bool RasterPasses::drawTransmitting(const RasterScene& scene, const RasterVisible& visible,
                                    const RasterLightFilters& filters) {
    const auto transmits = [](const RasterDraw& d) { return d.material->glsl.transmits; };
    if (std::none_of(scene.draws().begin(), scene.draws().end(), transmits)) return false;
    needRefraction();
    RasterDrawList backs;
    for (const RasterDraw& d : scene.draws())
        if (transmits(d)) backs.add(d, *d.surface, visible);
    backs.upload(true);
    _refraction->keep(_color, _depth);
    _refraction->beginBacks();
    backs.draw(_surfaces.vertexArray(), 0, backs.size(), true);
    _preview.target().bind();
    _refraction->bind();
    _surfaces.draw(scene, visible, RasterSurfaces::Transmitting, &filters);
    return true;
}

/// Over what is drawn already.
/// @param beforeGlass only what is before surfaces that transmit
void RasterPasses::drawSplats(const RasterScene& scene, bool beforeGlass) {
    if (scene.splats().empty()) return;
    _splatting.find(scene.splats(), _depth, beforeGlass ? &_refraction->depth() : nullptr);
    _pictureTarget.bind();
    _splatting.draw(RasterSplatting::Over::Last);
}

void RasterPasses::draw(const RasterScene& scene, const RasterLights& lights,
                        const RasterDomes& domes, const RasterCamera& camera,
                        const RasterSample& sample, Film& film) {
    film.allowNegative(lights.takeAway());
    // A volume is lit by all of a pass's lights, each of which takes long.
    const bool preview = sample.pass < uint32_t(PreviewPasses::passes) && scene.volumes().empty() &&
                         lights.samplesDomes();
    const PreviewSampler sampler(lights, scene.emitters(), _seen.bounds(), shadowMapSize,
                                 std::max(_width, _height), sample.pass);
    const int cells = RasterCasters::skyCells(scene), most = RasterCasters::mostMaps(scene);
    SampledLights sampled = preview ? sampler.samplePreview(cells, most) : sampler.sample(most);
    bool first = false;
    if (sample.pass == 0 && preview && !sampled.many)
        if (SampledLights some = sampler.sampleFirst(cells); some.taken > 0) {
            sampled = std::move(some);
            first = true;
        }
    drawImage(scene, lights, domes, camera, sample, sampled, preview);
    GlTimer& timer = _surfaces.timer;
    if (film.source() && _image) {
        _image->add(_color, preview ? &_preview.differenceImage() : nullptr, sample, first,
                    film.allowsNegative());
        return timer.collect();
    }
    timer.mark(GlTimer::ReadBack);
    std::vector<vec4> pixels;
    _surfaces.download.read(_color, pixels);
    timer.collect();
    _preview.add(pixels, sample, preview, first, _window, _surfaces.download, film);
}

void RasterPasses::drawImage(const RasterScene& scene, const RasterLights& lights,
                             const RasterDomes& domes, const RasterCamera& camera,
                             const RasterSample& sample, const SampledLights& sampled,
                             bool preview) {
    const uint32_t pass = sample.pass;
    static_assert(LightSampler::maxTaken * sizeof(GpuLight) <= 63232, "see isEnough()");
    std::vector<GpuLight> taken(sampled.lights.begin(), sampled.lights.begin() + sampled.taken);
    taken.resize(LightSampler::maxTaken);
    const GlBuffer takenBuffer(taken);

    const RasterView view = camera.view(sample.offset, sample.lens, sample.time, scene.seenMin(),
                                        scene.seenMax(), _border);
    RasterPassBlock b(scene, view);
    b.lightsTaken = sampled.taken;
    b.bsdfSamples = preview && lights.needsSky() ? PreviewPasses::bsdfSamples : bsdfSamples;
    b.passIndex = int(pass);
    b.passSeed = int(lights.seed());
    b.domeTexels = 1.0f;
    b.exposure = camera.camera().exposureScale;
    b.passesTaken = float(sample.taken);
    b.sceneExtent = glm::length(scene.boundsMax() - scene.boundsMin());
    b.lightsFound = sampled.found;
    b.firstSampled = sampled.firstSampled;
    b.firstShared = sampled.firstShared;
    b.sharedEvery = sampled.sharedEvery;
    if (lights.pixelsChoose()) {
        b.lightsChosen = LightSampler::chosen;
        const ShadowBounds& lit = _seen.bounds();
        const LightCells& cells =
            _manyLights.bind(sampled.estimates, size_t(sampled.firstShared), lit.receiverMin,
                             lit.receiverMax, lights.seed(), pass, LightSampler::maxTaken);
        b.cellsLow = cells.low;
        b.cellsPerUnit = cells.perUnit;
        b.cellsX = cells.sides.x;
        b.cellsY = cells.sides.y;
        b.cellsZ = cells.sides.z;
    }
    if (const GlTexture& map = domes.maps()) {
        map.bind(16);
        domes.densities().bind(17);
        if (domes.prefiltered()) domes.prefiltered().bind(20);
        b.domeLevel = map.levels() - 1;
        b.domeTexels = float(map.width()) * float(map.height());
    }
    const bool sky = lights.needsSky();
    if (sky) b.skySide = RasterSky::side;
    b.filteredSamples = std::clamp(scene.materials().environmentSamples(), 4, 1024);
    _surfaces.begin(b);
    _surfaces.timer.mark(GlTimer::Shadows);
    _casters.draw(scene, sampled.shadows, pass);
    if (sky) _casters.drawSky(scene, _seen.bounds(), lights.seed(), pass);
    lights.tables().writePass(sampled.tables);
    lights.tables().buffer().bindStorage(8);
    _surfaces.timer.mark(GlTimer::Surfaces);
    takenBuffer.bindUniform(4);
    _casters.bind();

    _colorTarget.bind();
    gl.Viewport(0, 0, _color.width(), _color.height());
    const float none[4] = {0, 0, 0, 0}, far = 1.0f;
    gl.ClearNamedFramebufferfv(_colorTarget.id(), GL_COLOR, 0, none);
    gl.ClearNamedFramebufferfv(_colorTarget.id(), GL_DEPTH, 0, &far);
    if (preview) _preview.clear();
    _background.draw(sampled, view, _color.width(), _color.height());
    gl.DepthFunc(GL_LESS);
    const RasterVisible visible = scene.visible(view.worldToClip);
    {
        const RasterClipping clipping(b);
        _surfaces.drawDepths(scene, visible);
        _preview.target().bind();
        _surfaces.draw(scene, visible, RasterSurfaces::Solid, &lights.filters());
    }
    if (!scene.splats().empty())
        _splatting.sort(scene.splats(), view, _color.width(), _color.height());
    drawSplats(scene, false);
    bool transmits = false;
    {
        const RasterClipping clipping(b);
        transmits = drawTransmitting(scene, visible, lights.filters());
    }
    if (transmits) drawSplats(scene, true);
    if (preview) _preview.smooth();
    if (preview && !scene.splats().empty()) {
        _preview.difference().bind();
        _splatting.draw(RasterSplatting::Over::AnyFactorsAlone);
    }
    {
        const RasterClipping clipping(b);
        gl.DepthMask(GL_FALSE);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_SRC1_COLOR);
        _colorTarget.bind();
        _surfaces.draw(scene, visible, RasterSurfaces::ColoredPresence, &lights.filters());
        if (preview) {
            gl.BlendFunc(GL_ZERO, GL_SRC1_COLOR);
            _preview.difference().bind();
            _surfaces.draw(scene, visible, RasterSurfaces::ColoredPresence, &lights.filters());
        }
        _colorTarget.bind();
    }
    gl.Disable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ZERO); // Mesa refuses several targets for dual sources, blending or not
    drawVolumes(scene);
    gl.DepthMask(GL_TRUE);
}

} // namespace patina
