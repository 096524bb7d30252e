// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterPasses.h"

#include "hdDelegate/raster/gl/deviceError.h"
#include "hdDelegate/raster/passes/rasterDrawList.h"
#include "hdDelegate/raster/passes/rasterPassBlock.h"
#include "shaders/shaders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

namespace patina {

RasterPasses::RasterPasses(std::string& error)
    : _passBuffer(sizeof(PassBlock), nullptr),
      _albedoTable(sh::ALBEDO_TABLE_SIZE * sizeof(float), patinaAlbedoTable) {
    gl.CreateVertexArrays(1, &_vertexArray);
    RasterScene::describe(_vertexArray);
    gl.CreateFramebuffers(1, &_shadowTarget);
    gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &_largest);
    _background = std::make_unique<RasterBackground>(error);
    if (!_background->ok()) return;
    _shadow = GlProgram::make(
        {{GL_VERTEX_SHADER, "shadow", "#include \"shaders/raster/shadow.vert.glsl\"\n"},
         {GL_FRAGMENT_SHADER, "shadow", "#include \"shaders/raster/shadow.frag.glsl\"\n"}},
        error);
    if (!_shadow) return;
    _shadowAround =
        GlProgram::make({{GL_VERTEX_SHADER, "shadow",
                          "#define AROUND_LIGHT\n#include \"shaders/raster/shadow.vert.glsl\"\n"},
                         {GL_FRAGMENT_SHADER, "shadow",
                          "#define AROUND_LIGHT\n#include \"shaders/raster/shadow.frag.glsl\"\n"}},
                        error);
    if (!_shadowAround) return;
    _look = std::make_unique<RasterLook>(error);
    if (!_look->ok()) return;
    _depthOnly = GlProgram::make({{GL_VERTEX_SHADER, "surface",
                                   "#define PRIMVARS 0\n#define DEPTH_ONLY\n"
                                   "#include \"shaders/raster/surface.vert.glsl\"\n"},
                                  {GL_FRAGMENT_SHADER, "shadow", "void main() {}\n"}},
                                 error);
    if (!_depthOnly) return;
    _receivers = GlProgram::make(
        {{GL_COMPUTE_SHADER, "receivers", "#include \"shaders/raster/receivers.comp.glsl\"\n"}},
        error);
}

RasterPasses::~RasterPasses() {
    gl.DeleteVertexArrays(1, &_vertexArray);
    gl.DeleteFramebuffers(1, &_shadowTarget);
}

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
    const auto make = [&](GLenum format, int beside) {
        return GlTexture(GL_TEXTURE_2D, format, width + 2 * beside, height + 2 * beside);
    };
    _color = make(GL_RGBA32F, border);
    _depth = make(GL_DEPTH_COMPONENT32F, border);
    _position = make(GL_RGBA32F, 0);
    _normal = make(GL_RGBA32F, 0);
    _ids = make(GL_RGBA32I, 0);
    _ids.parameter(GL_TEXTURE_MIN_FILTER, GL_NEAREST); // others do not read integers
    _ids.parameter(GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    _colorTarget = GlFramebuffer({&_color}, &_depth);
    _width = width;
    _height = height;
    _border = border;
    makeAovTarget(_aovRequest);
    return _colorTarget.complete() && _aovsComplete && _look->resize(_color, _depth);
}

const FilmSource& RasterPasses::beginImage(const EglContext& context, const RasterCamera& camera) {
    if (!_image) {
        std::string error;
        _image = std::make_unique<RasterImage>(context, error);
        if (!_image->ok()) throw DeviceError("the driver does not take the shaders: " + error);
    }
    if (!_image->begin(_width, _height, _window, camera, _position, _ids))
        throw DeviceError("the driver has no room for an image of this size");
    return *_image;
}

RasterPasses::PassBlock RasterPasses::block(const RasterScene& scene,
                                            const RasterView& view) const {
    PassBlock b;
    b.passOrigin = scene.origin();
    b.nearShift = view.fitted;
    b.farReach = view.reach;
    b.planes = Clipping::planesOf(view);
    std::copy_n(view.planes.begin(), b.planes, b.clipPlanes);
    b.worldToClip = view.worldToClip;
    b.clipToWorld = view.clipToWorld;
    b.isPerspective = view.perspective ? 1 : 0;
    b.eye = view.eye;
    b.forward = view.forward;
    b.pixelSpread = view.pixelSpread;
    return b;
}

/// Only what is in front has to be shaded, which takes far longer than to find it.
static bool isDrawnByDepth(const RasterDraw& d) {
    return !d.material->glsl.presence && !d.material->glsl.volumeOnly &&
           !d.material->glsl.transmits && !d.culls();
}

namespace {

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

void RasterPasses::drawSurfaces(const RasterScene& scene, const RasterVisible& visible, Which which,
                                const RasterLightFilters* filters) const {
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
    scene.bind(_vertexArray);
    DrawState last;
    for (size_t i = 0; i < states.size(); ++i) {
        const auto& [state, first] = states[i];
        const bool fresh = state.program != last.program;
        if (fresh) state.program->use();
        if (state.material != last.material) {
            state.material->bind();
            if (aovs && !_aovRequest.primvars.empty()) {
                int slots[RasterAovRequest::maxPrimvars] = {-1, -1, -1, -1};
                for (size_t p = 0; p < _aovRequest.primvars.size(); ++p)
                    slots[p] =
                        RasterAovRequest::slot(state.material->primvars, _aovRequest.primvars[p]);
                gl.Uniform4i(8, slots[0], slots[1], slots[2], slots[3]);
            }
        }
        if (!aovs && (fresh || state.glow != last.glow))
            gl.Uniform4f(7, state.glow.x, state.glow.y, state.glow.z, state.glow.w);
        if (!aovs && (fresh || state.table != last.table)) gl.Uniform1i(13, state.table);
        if (state.known != last.known) gl.DepthFunc(state.known ? GL_LEQUAL : GL_LESS);
        last = state;
        list.draw(_vertexArray, first, i + 1 < states.size() ? states[i + 1].second : list.size(),
                  true);
        const RasterPrograms& programs = *state.material->programs;
        if (!aovs && which != ColoredPresence && !programs.drawn) {
            programs.drawn = true;
            if (_firstDraws) _firstDraws();
        }
    }
    if (last.known) gl.DepthFunc(GL_LESS);
}

void RasterPasses::drawDepths(const RasterScene& scene, const RasterVisible& visible) const {
    RasterDrawList list;
    for (const RasterDraw& d : scene.draws())
        if (isDrawnByDepth(d)) list.add(d, *d.surface, visible);
    if (list.empty()) return;
    list.upload(false);
    scene.bind(_vertexArray);
    _depthOnly->use();
    gl.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    list.draw(_vertexArray, 0, list.size(), false);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void RasterPasses::resumeAt(const RasterScene& scene, const RasterLights& lights, uint32_t from,
                            uint32_t taken, const std::function<void(uint32_t)>& moveTo) {
    if (!lights.needsSky()) return;
    std::map<int, std::pair<uint32_t, RasterSky::Task>> last; // by cell
    for (uint32_t pass = from; pass < taken; ++pass)
        for (const RasterSky::Task& task :
             _sky.begin(pass, lights.seed(), _bounds, skyCells(scene)))
            last[task.layer] = {pass, task};
    std::multimap<uint32_t, RasterSky::Task> byPass;
    for (const auto& item : last)
        byPass.insert(item.second);
    gl.BindVertexArray(_vertexArray);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    for (const auto& [pass, task] : byPass) {
        moveTo(pass);
        PassBlock b;
        b.passOrigin = scene.origin();
        b.passIndex = int(pass);
        b.passSeed = int(lights.seed());
        _passBuffer.write(&b, sizeof b);
        _passBuffer.bindUniform(0);
        drawCasters(scene, task.view, pass, _sky.maps(), task.layer, _shownSky);
    }
}

void RasterPasses::needRefraction() {
    if (!_refraction) {
        std::string error;
        _refraction = std::make_unique<RasterRefraction>(error);
        if (!_refraction->ok()) throw DeviceError("the driver does not take the shaders: " + error);
    }
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
void RasterPasses::drawTransmitting(const RasterScene& scene, const RasterVisible& visible,
                                    const RasterLightFilters& filters) {
    const auto transmits = [](const RasterDraw& d) { return d.material->glsl.transmits; };
    if (std::none_of(scene.draws().begin(), scene.draws().end(), transmits)) return;
    needRefraction();
    RasterDrawList backs;
    for (const RasterDraw& d : scene.draws())
        if (transmits(d)) backs.add(d, *d.surface, visible);
    backs.upload(true);
    _refraction->keep(_color, _depth);
    _refraction->beginBacks();
    backs.draw(_vertexArray, 0, backs.size(), true);
    _look->target().bind();
    _refraction->bind();
    drawSurfaces(scene, visible, Transmitting, &filters);
}

void RasterPasses::draw(const RasterScene& scene, const RasterLights& lights,
                        const RasterDomes& domes, int environmentSamples,
                        const RasterCamera& camera, const RasterSample& sample, Film& film) {
    film.allowNegative(lights.takeAway());
    const uint32_t pass = sample.pass;
    const int longer = std::max(_width, _height);
    // A volume is lit by all of a pass's lights, each of which takes long.
    const bool look =
        pass < uint32_t(RasterLook::passes) && scene.volumes().empty() && lights.samplesDomes();
    const RasterLights::Sampled sampled =
        look ? lights.sampleLook(pass, scene.emitters(), _bounds, shadowMapSize, longer,
                                 skyCells(scene), mostMaps(scene))
             : lights.sample(pass, scene.emitters(), _bounds, shadowMapSize, longer,
                             mostMaps(scene));
    RasterImage* const image = film.source() ? _image.get() : nullptr;
    std::vector<vec4> pixels, smoothing;
    if (pass == 0) _first.clear();
    if (pass == 0 && look && !sampled.many) {
        const RasterLights::Sampled first =
            lights.sampleFirst(scene.emitters(), _bounds, shadowMapSize, longer, skyCells(scene));
        if (first.taken > 0) {
            drawImage(scene, lights, domes, environmentSamples, camera, sample, first, true);
            if (image) {
                image->add(_color, &_look->differenceImage(), sample, true, film.allowsNegative());
                return _timer.collect(_seconds);
            }
            readColor(pixels);
            _look->read(smoothing, _download);
            for (size_t i = 0; i < pixels.size(); ++i)
                pixels[i] += vec4(vec3(smoothing[i]), 0.0f);
            beginFirst(pixels, sample, film);
            return;
        }
    }
    drawImage(scene, lights, domes, environmentSamples, camera, sample, sampled, look);
    if (image) {
        image->add(_color, look ? &_look->differenceImage() : nullptr, sample, false,
                   film.allowsNegative());
        return _timer.collect(_seconds);
    }
    readColor(pixels);
    if (!_first.empty()) {
        showFirst(pixels, sample, film);
        return;
    }
    if (look) _look->read(smoothing, _download);
    addSplats(pixels, _width, _height, sample, _window, film);
    smooth(sample, look, smoothing, film);
}

void RasterPasses::drawImage(const RasterScene& scene, const RasterLights& lights,
                             const RasterDomes& domes, int environmentSamples,
                             const RasterCamera& camera, const RasterSample& sample,
                             const RasterLights::Sampled& sampled, bool look) {
    const uint32_t pass = sample.pass;
    std::vector<mat4> matrices;
    for (const ShadowView& v : sampled.shadows)
        matrices.push_back(v.worldToMap);
    static_assert(RasterLights::maxTaken * sizeof(GpuLight) <= 63232, "see isEnough()");
    std::vector<GpuLight> taken(sampled.lights.begin(), sampled.lights.begin() + sampled.taken);
    taken.resize(RasterLights::maxTaken);
    const GlBuffer takenBuffer(taken), matrixBuffer(matrices);

    const RasterView view = camera.view(sample.offset, sample.lens, sample.time, scene.boundsMin(),
                                        scene.boundsMax(), _border);
    PassBlock b = block(scene, view);
    b.lightsTaken = sampled.taken;
    b.bsdfSamples = look && lights.needsSky() ? RasterLook::bsdfSamples : bsdfSamples;
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
        b.lightsChosen = RasterLights::chosen;
        b.cellsLow = sampled.cells.low;
        b.cellsPerUnit = sampled.cells.perUnit;
        b.cellsX = sampled.cells.sides.x;
        b.cellsY = sampled.cells.sides.y;
        b.cellsZ = sampled.cells.sides.z;
        _manyLights.bind(sampled.estimates, sampled.cells, RasterLights::maxTaken);
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
    b.filteredSamples = std::clamp(environmentSamples, 4, 1024);
    _passBuffer.write(&b, sizeof b);
    _passBuffer.bindUniform(0);
    gl.BindVertexArray(_vertexArray);
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(GL_LESS);
    gl.DepthMask(GL_TRUE);
    _albedoTable.bindStorage(7);
    _timer.mark(Shadows);
    drawShadows(scene, sampled.shadows, sampled.mapSize, pass);
    if (sky) {
        drawSky(scene, lights, pass);
        _sky.bind(10, 19);
    }
    lights.tables().writePass(sampled.tables);
    lights.tables().buffer().bindStorage(8);
    _timer.mark(Surfaces);
    takenBuffer.bindUniform(4);
    matrixBuffer.bindStorage(5);
    _shadowMaps.bind(18);
    _shadowSlopes.bind(25);

    _colorTarget.bind();
    gl.Viewport(0, 0, _color.width(), _color.height());
    const float none[4] = {0, 0, 0, 0}, far = 1.0f;
    gl.ClearNamedFramebufferfv(_colorTarget.id(), GL_COLOR, 0, none);
    gl.ClearNamedFramebufferfv(_colorTarget.id(), GL_DEPTH, 0, &far);
    if (look) _look->clear();
    _background->draw(sampled, view, _color.width(), _color.height());
    gl.DepthFunc(GL_LESS);
    const RasterVisible visible = scene.visible(view.worldToClip);
    {
        const Clipping clipping(view);
        drawDepths(scene, visible);
        _look->target().bind();
        drawSurfaces(scene, visible, Solid, &lights.filters());
    }
    {
        const Clipping clipping(view);
        drawTransmitting(scene, visible, lights.filters());
    }
    if (look) _look->smooth();
    {
        const Clipping clipping(view);
        gl.DepthMask(GL_FALSE);
        gl.Enable(GL_BLEND);
        gl.BlendFunc(GL_ONE, GL_SRC1_COLOR);
        _colorTarget.bind();
        drawSurfaces(scene, visible, ColoredPresence, &lights.filters());
        if (look) {
            gl.BlendFunc(GL_ZERO, GL_SRC1_COLOR);
            _look->difference().bind();
            drawSurfaces(scene, visible, ColoredPresence, &lights.filters());
        }
        _colorTarget.bind();
    }
    gl.Disable(GL_BLEND);
    gl.BlendFunc(GL_ONE, GL_ZERO); // Mesa refuses several targets for dual sources, blending or not
    drawVolumes(scene);
    gl.DepthMask(GL_TRUE);
}

void RasterPasses::readColor(std::vector<vec4>& pixels) {
    _timer.mark(ReadBack);
    pixels.resize(size_t(_color.width()) * size_t(_color.height()));
    _download.read(_color, GL_RGBA, GL_FLOAT, pixels.size() * sizeof(vec4), pixels.data());
    _timer.collect(_seconds);
}

} // namespace patina
