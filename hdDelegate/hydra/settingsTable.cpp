#include "hdDelegate/hydra/settingsTable.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/tokens.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace patina {

namespace {

struct Row {
    TfToken key;
    std::string label;
    VtValue initial;
    std::function<bool(HdPatinaSettings&, const VtValue&)> set; ///< false: out of range
};

std::optional<double> numberOf(const VtValue& value) {
    if (value.IsHolding<bool>()) return value.UncheckedGet<bool>() ? 1.0 : 0.0;
    const VtValue number = VtValue::Cast<double>(value);
    if (number.IsHolding<double>() && std::isfinite(number.UncheckedGet<double>()))
        return number.UncheckedGet<double>();
    const VtValue text = VtValue::Cast<std::string>(value);
    if (!text.IsHolding<std::string>()) return std::nullopt;
    const std::string& s = text.UncheckedGet<std::string>();
    if (s == "true" || s == "on") return 1.0;
    if (s == "false" || s == "off") return 0.0;
    char* end = nullptr;
    const double parsed = std::strtod(s.c_str(), &end);
    if (s.empty() || *end != '\0' || !std::isfinite(parsed)) return std::nullopt;
    return parsed;
}

std::optional<std::string> textOf(const VtValue& value) {
    if (value.IsHolding<TfToken>()) return value.UncheckedGet<TfToken>().GetString();
    if (value.IsHolding<std::string>()) return value.UncheckedGet<std::string>();
    return std::nullopt;
}

Row flag(const char* key, const char* label, bool RenderSettings::*member, bool initial) {
    return {TfToken(key), label, VtValue(initial), [member](HdPatinaSettings& s, const VtValue& v) {
                s.*member = v.UncheckedGet<bool>();
                return true;
            }};
}

Row flag(const char* key, const char* label, bool RenderSettings::*member) {
    return flag(key, label, member, RenderSettings().*member);
}

Row integer(const char* key, const char* label, int RenderSettings::*member, int minimum,
            int maximum) {
    return {TfToken(key), label, VtValue(RenderSettings().*member),
            [=](HdPatinaSettings& s, const VtValue& v) {
                const int value = v.UncheckedGet<int>();
                if (value < minimum || value > maximum) return false;
                s.*member = value;
                return true;
            }};
}

template <class T> Row real(const char* key, const char* label, T RenderSettings::*member) {
    return {TfToken(key), label, VtValue(float(RenderSettings().*member)),
            [=](HdPatinaSettings& s, const VtValue& v) {
                const float value = v.UncheckedGet<float>();
                if (!(value >= 0.0f)) return false;
                s.*member = value;
                return true;
            }};
}

Row choice(const char* key, const char* label, std::string HdPatinaSettings::*member,
           std::vector<std::string> names) {
    return {TfToken(key), label, VtValue(HdPatinaSettings().*member),
            [=](HdPatinaSettings& s, const VtValue& v) {
                const std::string& value = v.UncheckedGet<std::string>();
                for (const std::string& name : names)
                    if (name == value) {
                        s.*member = value;
                        return true;
                    }
                return false;
            }};
}

Row seedRow() {
    return {TfToken("seed"), "Random seed", VtValue(0), [](HdPatinaSettings& s, const VtValue& v) {
                s.seed = uint32_t(v.UncheckedGet<int>());
                return true;
            }};
}

Row denoiseRow() {
    return {TfToken("denoise"), "Denoise (Open Image Denoise, where it is found)",
            VtValue(HdPatinaSettings().denoise), [](HdPatinaSettings& s, const VtValue& v) {
                s.denoise = v.UncheckedGet<bool>();
                return true;
            }};
}

/// Negative, as it is at first: all samples by the default methods.
Row toleranceRow() {
    return {TfToken("tolerance"), "Tolerance (mean relative error; 0: truth, -1: all samples)",
            VtValue(float(RenderSettings().tolerance)), [](HdPatinaSettings& s, const VtValue& v) {
                const float value = v.UncheckedGet<float>();
                if (!(value >= 0.0f) && value != -1.0f) return false;
                s.tolerance = value;
                return true;
            }};
}

/// Negative, as it is at first: planned.
Row edgeLengthRow() {
    return {TfToken("edgeLength"),
            "Edge length of subdivided meshes (pixels; -1: as the tolerance asks)",
            VtValue(RenderSettings().edgeLength), [](HdPatinaSettings& s, const VtValue& v) {
                const float value = v.UncheckedGet<float>();
                if (!(value >= 0.0f) && value != -1.0f) return false;
                s.edgeLength = value;
                return true;
            }};
}

const std::vector<Row>& rows() {
    using S = RenderSettings;
    constexpr int maximum = std::numeric_limits<int>::max();
    static const std::vector<Row> table = {
        choice("backend", "Back end (auto, embree, raster, interactive)",
               &HdPatinaSettings::backend, {"auto", "embree", "raster", "interactive"}),
        integer("samples", "Samples per pixel", &S::samples, 1, maximum),
        integer("minSamples", "Least samples per pixel", &S::minSamples, 1, maximum),
        toleranceRow(),
        real("seconds", "Time limit (seconds, 0: none)", &S::seconds),
        integer("threads", "Threads (0: all)", &S::threads, 0, 4096),
        seedRow(),
        integer("maxDepth", "Path depth (-1: as the tolerance asks)", &S::maxDepth, -1, 4096),
        integer("lightSamples", "Light samples at what the camera sees", &S::lightSamples, 1, 1024),
        integer("rouletteDepth", "Russian roulette from depth", &S::rouletteDepth, 0, 4096),
        real("indirectClamp", "Clamp of indirect samples (0: none)", &S::indirectClamp),
        denoiseRow(),
        real("filterRadius", "Pixel filter radius (pixels)", &S::filterRadius),
        flag("enableSceneLights", "Scene lights", &S::enableSceneLights),
        flag("enableSceneMaterials", "Scene materials", &S::enableSceneMaterials),
        flag("enableShadows", "Shadows", &S::enableShadows),
        flag("enableMotionBlur", "Motion blur", &S::enableMotionBlur),
        flag("enableDepthOfField", "Depth of field", &S::enableDepthOfField),
        flag("domeLightCameraVisibility", "Dome lights seen by the camera",
             &S::domeLightCameraVisibility),
        choice("cullStyle", "Faces culled for the camera", &S::cullStyle,
               {"nothing", "back", "front", "backUnlessDoubleSided", "frontUnlessDoubleSided"}),
        edgeLengthRow(),
        choice("integrator", "Integrator (path, ambientOcclusion)", &S::integrator,
               {"path", "ambientOcclusion"}),
        integer("ambientOcclusionSamples", "Ambient occlusion rays per hit",
                &S::ambientOcclusionSamples, 1, 65536),
        integer("environmentSamples", "Rasterizer: samples of domes (-1: as the tolerance asks)",
                &S::environmentSamples, -1, 1024),
        flag("interactive", "Interactive (quick starts before speed)", &S::interactive, true),
    };
    return table;
}

const Row* rowOf(const TfToken& key) {
    for (const Row& row : rows())
        if (row.key == key) return &row;
    return nullptr;
}

bool isMethod(const std::string& name) {
    return TfStringStartsWith(name, "method:");
}

} // namespace

HdRenderSettingDescriptorList settingDescriptors(const std::string& backend) {
    HdRenderSettingDescriptorList list;
    for (const Row& row : rows())
        list.push_back({row.label, row.key, row.key == "backend" ? VtValue(backend) : row.initial});
    return list;
}

std::string backendOf(const HdPatinaSettings& settings) {
    return settings.backend == "auto" && !settings.interactive ? "embree" : settings.backend;
}

TfToken settingKey(const TfToken& name) {
    if (name == HdRenderSettingsTokens->convergedSamplesPerPixel) return TfToken("samples");
    if (name == HdRenderSettingsTokens->convergedVariance) return TfToken("tolerance");
    if (name == HdRenderSettingsTokens->threadLimit) return TfToken("threads");
    if (name == HdRenderSettingsTokens->enableInteractive) return TfToken("interactive");
    std::string text = name.GetString();
    for (const char* prefix : {"patina:global:", "patina:"})
        if (TfStringStartsWith(text, prefix)) {
            text = text.substr(std::string(prefix).size());
            break;
        }
    const TfToken key(text);
    return rowOf(key) || isMethod(text) ? key : TfToken();
}

VtValue settingValue(const TfToken& key, const VtValue& value) {
    if (isMethod(key.GetString())) {
        const auto text = textOf(value);
        return text ? VtValue(*text) : VtValue();
    }
    const Row* row = rowOf(key);
    if (!row) return VtValue();
    if (row->initial.IsHolding<std::string>()) {
        const auto text = textOf(value);
        return text ? VtValue(*text) : VtValue();
    }
    const auto number = numberOf(value);
    if (!number) return VtValue();
    if (row->initial.IsHolding<bool>()) return VtValue(*number != 0.0);
    if (row->initial.IsHolding<float>()) return VtValue(float(*number));
    if (std::abs(*number) > 4294967295.0) return VtValue();
    return VtValue(int(int64_t(*number)));
}

std::string applySetting(const TfToken& key, const VtValue& value, HdPatinaSettings& settings) {
    const VtValue converted = settingValue(key, value);
    if (converted.IsEmpty()) return "has a value of the wrong type; it is left as it was";
    if (isMethod(key.GetString())) {
        settings.methods[key.GetString().substr(7)] = converted.UncheckedGet<std::string>();
        return std::string();
    }
    if (!rowOf(key)->set(settings, converted))
        return "has a value that is not allowed; it is left as it was";
    return std::string();
}

} // namespace patina
