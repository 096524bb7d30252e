// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/engine/engine.h"

#include "testenv/hydra/host/editScript.h"

#include <pxr/imaging/glf/simpleLight.h>
#include <pxr/imaging/glf/simpleMaterial.h>
#include <pxr/imaging/hd/renderBuffer.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/imaging/hdx/tokens.h>
#include <pxr/imaging/hgi/texture.h>
#include <pxr/usd/usd/prim.h>
#include <pxr/usdImaging/usdImagingGL/engine.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace patina {

Engine::Engine(const UsdStageRefPtr& stage, const EngineOptions& options)
    : _options(options), _context(options.glx), _stage(stage) {
    _engine = std::make_unique<UsdImagingGLEngine>(HdDriver(), TfToken(options.renderer), true);
    if (_engine->GetCurrentRendererId() != TfToken(options.renderer))
        throw std::runtime_error("the renderer " + options.renderer +
                                 " is not found or does not start (see PXR_PLUGINPATH_NAME)");
    _engine->SetEnablePresentation(false);
    for (const std::string& setting : options.settings) {
        const size_t equal = setting.find('=');
        if (equal == std::string::npos)
            throw std::runtime_error("--set needs KEY=VALUE, not " + setting);
        _engine->SetRendererSetting(TfToken(setting.substr(0, equal)),
                                    settingOf(setting.substr(equal + 1)));
    }
    _engine->SetRendererAov(TfToken(options.aov));
    _engine->SetCameraPath(options.camera);
    _engine->SetRenderBufferSize(GfVec2i(options.width, options.height));
    _engine->SetFraming(CameraUtilFraming(GfRect2i(GfVec2i(0), options.width, options.height)));
    _engine->SetLightingState(GlfSimpleLightVector(), GlfSimpleMaterial(), GfVec4f(0.0f));
}

Engine::~Engine() {
    _engine.reset(); // while its context is current
}

namespace {

bool showsImage(const VtDictionary& statistics) {
    const auto found = statistics.find("patina:imagesShown");
    return found != statistics.end() && found->second.GetWithDefault(0.0) > 0.0;
}

UsdImagingGLRenderParams paramsOfAll() {
    UsdImagingGLRenderParams params;
    params.frame = UsdTimeCode::Default();
    params.colorCorrectionMode = HdxColorCorrectionTokens->disabled;
    params.showRender = true;
    params.clearColor = GfVec4f(0.0f);
    return params;
}

} // namespace

void Engine::select(const SdfPath& path, int times) {
    UsdImagingGLRenderParams params = paramsOfAll();
    params.highlight = true;
    _engine->SetSelectionColor(GfVec4f(1.0f, 0.0f, 0.0f, 0.5f));
    _engine->SetSelected({path});
    for (int i = 0; i < times; ++i)
        _engine->Render(_stage->GetPseudoRoot(), params);
}

double Engine::render() {
    const UsdImagingGLRenderParams params = paramsOfAll();
    using Clock = std::chrono::steady_clock;
    const Clock::duration least = std::chrono::milliseconds(1),
                          most = std::chrono::milliseconds(16);
    const auto start = Clock::now();
    Clock::duration seen(0);
    for (_engine->Render(_stage->GetPseudoRoot(), params); !_engine->IsConverged();
         _engine->Render(_stage->GetPseudoRoot(), params)) {
        if (seen == Clock::duration(0) && showsImage(_engine->GetRenderStats()))
            seen = Clock::now() - start;
        // Each look takes time from the renderer, so that only quick images are looked at often.
        std::this_thread::sleep_for(std::clamp((Clock::now() - start) / 32, least, most));
    }
    HdRenderBuffer& image = buffer();
    image.Resolve();
    if (!image.GetResource(false).IsEmpty()) {
        _context.finish();
    } else {
        if (!image.Map()) throw std::runtime_error("the buffer cannot be read");
        image.Unmap();
    }
    const Clock::duration whole = Clock::now() - start;
    return std::chrono::duration<double>(seen == Clock::duration(0) ? whole : seen).count();
}

VtDictionary Engine::statistics() const {
    return _engine->GetRenderStats();
}

HdRenderBuffer& Engine::buffer() const {
    HdRenderBuffer* found = _engine->GetAovRenderBuffer(TfToken(_options.aov));
    if (!found) throw std::runtime_error("there is no buffer of " + _options.aov);
    return *found;
}

void Engine::write(const std::string& file) {
    HdRenderBuffer& image = buffer();
    const int width = int(image.GetWidth()), height = int(image.GetHeight());
    HdFormat format = image.GetFormat();
    const VtValue resource = image.GetResource(false);
    std::vector<float> drawn;
    if (!_options.mapped && resource.IsHolding<HgiTextureHandle>()) {
        const HgiTextureHandle texture = resource.UncheckedGet<HgiTextureHandle>();
        drawn = _context.read(unsigned(texture->GetRawResource()), width, height,
                              int(HdGetComponentCount(format)),
                              texture->GetDescriptor().usage & HgiTextureUsageBitsDepthTarget);
        format = format == HdFormatFloat32 ? format : HdFormatFloat32Vec4;
    }
    const auto type = format == HdFormatUNorm8Vec4    ? OIIO::TypeDesc::UINT8
                      : format == HdFormatFloat16Vec4 ? OIIO::TypeDesc::HALF
                      : format == HdFormatFloat32Vec4 ? OIIO::TypeDesc::FLOAT
                      : format == HdFormatFloat32     ? OIIO::TypeDesc::FLOAT
                                                      : OIIO::TypeDesc::UNKNOWN;
    if (type == OIIO::TypeDesc::UNKNOWN)
        throw std::runtime_error("the buffer has an unknown format");
    const OIIO::TypeDesc pixel(type);
    const int channels = int(HdGetComponentCount(format));
    const char* data = static_cast<const char*>(drawn.empty() ? image.Map() : drawn.data());
    const auto out = OIIO::ImageOutput::create(file);
    // Hydra's buffers begin below.
    const OIIO::stride_t row = OIIO::stride_t(pixel.size()) * channels * width;
    const bool written =
        data && out && out->open(file, OIIO::ImageSpec(width, height, channels, pixel)) &&
        out->write_image(pixel, data + row * (height - 1), OIIO::AutoStride, -row) && out->close();
    if (drawn.empty()) image.Unmap();
    if (!written) throw std::runtime_error(file + " cannot be written");
}

} // namespace patina
