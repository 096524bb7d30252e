// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderProducts.h"

#include "hdDelegate/film/aovTable.h"
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/hydra/aovs.h"
#include "hdDelegate/hydra/values.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace patina {

namespace {

std::string lightPathText(const std::string& name) {
    const size_t length = sizeof lightPathAovs - 1;
    return name.compare(0, length, lightPathAovs) == 0 ? name.substr(length) : name;
}

/// NAME=lpe:EXPR. The name is what its host's driver calls it, else the prim's.
std::string lightPathAov(const HdRenderSettings::RenderProduct::RenderVar& var) {
    const std::string expression = lightPathText(var.sourceName);
    if (expression.empty()) return "";
    if (expression == "C.*") return "color";
    std::string name = var.varPath.GetName();
    for (const char* key : {"ri:driver:parameters:aov:name", "driver:parameters:aov:name"}) {
        const auto found = var.namespacedSettings.find(key);
        if (found == var.namespacedSettings.end()) continue;
        const std::string own = textOf(found->second);
        if (!own.empty()) name = own;
    }
    const bool taken = name.empty() || aovIdOf(name) != AovId::unknown;
    return (taken ? "" : name + "=") + lightPathAovs + expression;
}

std::string filmAovOfVar(const HdRenderSettings::RenderProduct::RenderVar& var) {
    const std::string& name = var.sourceName;
    if (var.sourceType == "primvar") return filmAovOf(TfToken("primvars:" + name));
    if (name == "Ci" || name == "beauty" || name == "C.*") return "color";
    if (name == "a") return "alpha";
    if (name == "z") return "depth";
    if (name == "N") return "normal";
    if (name == "P") return "position";
    if (var.sourceType == "lpe" || lightPathText(name) != name) return lightPathAov(var);
    return filmAovOf(TfToken(aovNamed(name)));
}

/// The error in its light path expression; empty for none.
std::string problemOf(const std::string& aov) {
    try {
        standardAov(aov);
        return "";
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
}

constexpr double largestSize = 65536.0; // pixels, as of --imageWidth

/// The place between two pixels of an edge; the frame has 0 to 1.
int edgeOf(double edge, int size) {
    return int(std::clamp(std::round(edge * size), -largestSize, size + largestSize));
}

/// The pixels, first and last, whose centres lie in a rectangle of [0,1], y up; all of them where a
/// host gives none. @returns nullopt where there is no such pixel
std::optional<PixelWindow> pixelsOf(const GfRange2f& ndc, int width, int height) {
    if (ndc == GfRange2f() || ndc == GfRange2f(GfVec2f(0.0f), GfVec2f(1.0f))) return allPixels;
    const GfVec2f &least = ndc.GetMin(), &most = ndc.GetMax();
    for (int i = 0; i < 2; ++i)
        if (!std::isfinite(least[i]) || !std::isfinite(most[i])) return std::nullopt;
    const PixelWindow window = {edgeOf(least[0], width), edgeOf(1.0 - most[1], height),
                                edgeOf(most[0], width) - 1, edgeOf(1.0 - least[1], height) - 1};
    if (window[2] < window[0] || window[3] < window[1]) return std::nullopt;
    return window;
}

/// Sets the film's size. Where the data window reaches beyond the frame, the film is that window.
/// @returns false where pixels beside the frame are left out
bool place(HdPatinaSettings& s, PixelWindow window, const Scene& scene, const std::string& camera) {
    const bool inside = window == allPixels || (window[0] >= 0 && window[1] >= 0 &&
                                                window[2] < s.width && window[3] < s.height);
    s.dataWindow = window;
    if (inside) return true;
    const auto state = scene.snapshot();
    const auto found = state->cameras.find(camera);
    const int width = window[2] - window[0] + 1, height = window[3] - window[1] + 1;
    if (std::max(width, height) <= largestSize &&
        (found == state->cameras.end() || found->second->lens.hasOverscan())) {
        const int right = s.width - 1 - window[0], bottom = s.height - 1 - window[1];
        s.frameWindow = {-window[0], -window[1], right, bottom};
        s.dataWindow = allPixels;
        s.width = width, s.height = height;
        return true;
    }
    s.dataWindow = {std::max(window[0], 0), std::max(window[1], 0),
                    std::min(window[2], s.width - 1), std::min(window[3], s.height - 1)};
    return false;
}

bool flagOf(const VtDictionary& settings, const char* name, bool initial) {
    const auto found = settings.find(name);
    if (found == settings.end()) return initial;
    const VtValue value = VtValue::Cast<bool>(found->second);
    return value.GetWithDefault<bool>(initial);
}

} // namespace

HdPatinaRenderProducts::HdPatinaRenderProducts(HdPatinaDelegateState& state) : _state(state) {}

HdPatinaRenderProducts::~HdPatinaRenderProducts() = default;

bool HdPatinaRenderProducts::wanted() const {
    return !_state.settings().interactive && !_state.products().empty();
}

std::vector<std::string> HdPatinaRenderProducts::aovs() const {
    std::vector<std::string> found;
    if (!wanted()) return found;
    for (const auto& product : _state.products())
        for (const auto& var : product.renderVars)
            found.push_back(filmAovOfVar(var));
    return found;
}

bool HdPatinaRenderProducts::prepare(const HdRenderSettings::RenderProduct& product,
                                     Output& output) {
    HdPatinaRenderParam& param = _state.param;
    output.path = product.productPath;
    output.file = product.name.GetString();
    output.camera = product.cameraPath.GetString();
    output.settings = _state.settings();
    HdPatinaSettings& s = output.settings;
    s.deep = product.type == "deepRaster";
    if (product.type != "raster" && !s.deep) {
        param.warn(product.productPath, "productType",
                   messages::productTypeUnknown(product.type.GetString()));
        return false;
    }
    if (output.file.empty()) {
        param.warn(product.productPath, "productName", messages::productNameEmpty);
        return false;
    }
    s.width = product.resolution[0];
    s.height = product.resolution[1];
    s.pixelAspectRatio = product.pixelAspectRatio > 0.0f ? product.pixelAspectRatio : 1.0;
    if (!product.aspectRatioConformPolicy.IsEmpty())
        s.aspectRatioConformPolicy = product.aspectRatioConformPolicy.GetString();
    const auto window = pixelsOf(product.dataWindowNDC, s.width, s.height);
    if (!window)
        param.warn(product.productPath, "dataWindowNDC", messages::windowEmpty);
    else if (!place(s, *window, *param.scene(), output.camera))
        param.warn(product.productPath, "dataWindowNDC", messages::windowBeyondImage);
    s.enableMotionBlur = s.enableMotionBlur && !product.disableMotionBlur;
#if PATINA_HAS_PRODUCT_DEPTH_OF_FIELD
    s.enableDepthOfField = s.enableDepthOfField && !product.disableDepthOfField;
#endif
    for (const auto& var : product.renderVars) {
        const std::string aov = filmAovOfVar(var);
        const std::string problem = problemOf(aov);
        if (aov.empty())
            param.warn(var.varPath, "sourceName", messages::aovUnknown(var.sourceName));
        else if (!problem.empty())
            param.warn(var.varPath, "sourceName", messages::aovLeftOut(problem));
        else if (std::find(output.order.begin(), output.order.end(), aov) == output.order.end())
            output.order.push_back(aov);
    }
    if (s.deep) {
        for (const std::string& aov : output.order)
            if (aov != "color" && aov != "alpha" && aov != "depth")
                param.warn(product.productPath, "orderedVars", messages::deepVarLeftOut(aov));
        output.order.clear();
    } else if (output.order.empty()) {
        output.order = {"color", "alpha"};
    }
    s.aovs = output.order;
    try {
        checkImagePath(output.file, output.order);
    } catch (const std::exception& error) {
        param.warn(product.productPath, "productName", messages::productUnwritable(error.what()));
        return false;
    }
    return true;
}

bool HdPatinaRenderProducts::update() {
    _state.param.commit();
    const uint64_t sceneVersion = _state.param.scene()->snapshot()->version;
    const unsigned int settingsVersion = _state.settingsVersion();
    if (!_started || sceneVersion != _sceneVersion || settingsVersion != _settingsVersion) {
        _started = true;
        _sceneVersion = sceneVersion;
        _settingsVersion = settingsVersion;
        _outputs.clear();
        _next = 0;
        for (const auto& product : _state.products()) {
            Output output;
            if (prepare(product, output)) _outputs.push_back(std::move(output));
        }
        if (!_session) _session = _state.makeSession();
        startNext();
    }
    if (_next >= _outputs.size()) return true;
    const auto frame = _session->take();
    if (!frame || !frame->last) return false;
    const Output& output = _outputs[_next];
    if (frame->error.empty())
        write(output);
    else
        _state.param.warn(output.path, "", messages::productNotRendered(frame->error));
    ++_next;
    startNext();
    return _next >= _outputs.size();
}

void HdPatinaRenderProducts::startNext() {
    if (_next < _outputs.size())
        _session->start(_outputs[_next].camera, _outputs[_next].settings, {});
}

void HdPatinaRenderProducts::write(const Output& output) {
    _session->stop(); // the film is at rest, and no listener runs any more
    ImageOptions options;
    options.aovs = output.order;
    options.deep = output.settings.deep;
    if (options.deep && !_session->film()->deep()) return; // the back end has said so
    const HdPatinaSettings& s = output.settings;
    const PixelWindow& frame = s.frameWindow;
    PixelWindow window = s.dataWindow;
    options.displayWidth = s.width;
    options.displayHeight = s.height;
    if (frame != allPixels) { // with overscan
        options.displayWidth = frame[2] - frame[0] + 1;
        options.displayHeight = frame[3] - frame[1] + 1;
        window = {-frame[0], -frame[1], s.width - 1 - frame[0], s.height - 1 - frame[1]};
    }
    std::copy(window.begin(), window.end(), options.dataWindow);
    options.pixelAspectRatio = output.settings.pixelAspectRatio;
    for (const auto& product : _state.products())
        if (product.productPath == output.path) {
            options.half = flagOf(product.namespacedSettings, "patina:half", options.half);
            for (const auto& var : product.renderVars)
                if (filmAovOfVar(var) == "color" &&
                    (var.dataType == "color3h" || var.dataType == "half3" ||
                     var.dataType == "color4h" || var.dataType == "half4"))
                    options.half = true;
        }
    options.renderingSpace = &_state.param.renderingSpace();
    try {
        writeImage(*_session->film(), output.file, options,
                   {{"Software", std::string("Patina")},
                    {"patina:camera", output.camera},
                    {"patina:samples", output.settings.samples}});
    } catch (const std::exception& error) {
        _state.param.warn(output.path, "productName", messages::productUnwritable(error.what()));
    }
}

} // namespace patina
