// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/settingsTable.h"

#include "hdDelegate/scene/settingRows.h"
#include "materialNetwork/plan/methods.h"

#include <pxr/base/tf/diagnostic.h>
#include <pxr/base/tf/stringUtils.h>

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <vector>

namespace patina {

namespace {

struct Row {
    TfToken key;
    std::string label;
    VtValue initial;
    std::function<bool(HdPatinaSettings&, const VtValue&)> set; ///< false: out of range
    bool isUnsigned = false; ///< hosts' integers hold the same bits
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

std::optional<std::string> givenText(const VtValue& value) {
    if (value.IsHolding<TfToken>()) return value.UncheckedGet<TfToken>().GetString();
    if (value.IsHolding<std::string>()) return value.UncheckedGet<std::string>();
    return std::nullopt;
}

/// A row for a setting of the renderer: Hydra knows booleans, integers, floats and texts.
Row rowFor(const SettingRow& setting) {
    Row row{TfToken(setting.name), setting.shown, {}, {}, false};
    const auto numeric = [&](auto member, auto as) {
        using Shown = decltype(as);
        row.initial = VtValue(Shown(HdPatinaSettings().*member));
        row.set = [&setting, member](HdPatinaSettings& s, const VtValue& v) {
            const Shown value = v.UncheckedGet<Shown>();
            if (!setting.takes(double(value))) return false;
            s.*member = std::decay_t<decltype(s.*member)>(value);
            return true;
        };
    };
    const auto text = [&](std::string RenderSettings::*member) {
        row.initial = VtValue(HdPatinaSettings().*member);
        row.set = [&setting, member](HdPatinaSettings& s, const VtValue& v) {
            const std::string& value = v.UncheckedGet<std::string>();
            if (!setting.takes(value)) return false;
            s.*member = value;
            return true;
        };
    };
    std::visit(
        [&](auto member) {
            using T = std::decay_t<decltype(RenderSettings().*member)>;
            if constexpr (std::is_same_v<T, bool>)
                numeric(member, bool());
            else if constexpr (std::is_same_v<T, int> || std::is_same_v<T, uint32_t>) {
                numeric(member, int());
                row.isUnsigned = std::is_same_v<T, uint32_t>;
            } else if constexpr (std::is_floating_point_v<T>)
                numeric(member, float());
            else if constexpr (std::is_same_v<T, std::string>)
                text(member);
            else
                TF_CODING_ERROR("hosts cannot show the setting %s", setting.name.c_str());
        },
        setting.member);
    return row;
}

Row backendRow() {
    return {TfToken("backend"), "Back end (auto, embree, raster, interactive)",
            VtValue(HdPatinaSettings().backend), [](HdPatinaSettings& s, const VtValue& v) {
                const std::string& value = v.UncheckedGet<std::string>();
                for (const char* name : {"auto", "embree", "raster", "interactive"})
                    if (value == name) {
                        s.backend = value;
                        return true;
                    }
                return false;
            }};
}

Row denoiseRow(const char* name, const char* label, bool HdPatinaSettings::*field) {
    return {TfToken(name), label, VtValue(HdPatinaSettings().*field),
            [field](HdPatinaSettings& s, const VtValue& v) {
                s.*field = v.UncheckedGet<bool>();
                return true;
            }};
}

const std::vector<Row>& rows() {
    static const std::vector<Row> table = [] {
        std::vector<Row> made = {backendRow()};
        for (const SettingRow& setting : settingRows()) {
            if (setting.shown.empty()) continue;
            made.push_back(rowFor(setting));
            if (setting.name == "interactive") made.back().initial = VtValue(true);
            if (setting.name != "indirectClamp") continue;
            made.push_back(denoiseRow("denoise", "Denoise (Open Image Denoise, where it is found)",
                                      &HdPatinaSettings::denoise));
            made.push_back(denoiseRow("denoiseAovs", "Denoise AOVs of light, too",
                                      &HdPatinaSettings::denoiseAovs));
        }
        return made;
    }();
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
    for (const SettingRow& setting : settingRows())
        if (!setting.hydraName.empty() && name == setting.hydraName) return TfToken(setting.name);
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
        const auto text = givenText(value);
        return text ? VtValue(*text) : VtValue();
    }
    const Row* row = rowOf(key);
    if (!row) return VtValue();
    if (row->initial.IsHolding<std::string>()) {
        const auto text = givenText(value);
        return text ? VtValue(*text) : VtValue();
    }
    const auto number = numberOf(value);
    if (!number) return VtValue();
    if (row->initial.IsHolding<bool>()) return VtValue(*number != 0.0);
    if (row->initial.IsHolding<float>()) {
        if (std::abs(*number) > std::numeric_limits<float>::max()) return VtValue();
        return VtValue(float(*number));
    }
    const double most = row->isUnsigned ? double(std::numeric_limits<uint32_t>::max())
                                        : double(std::numeric_limits<int>::max());
    if (*number < double(std::numeric_limits<int>::min()) || *number > most) return VtValue();
    return VtValue(int(int64_t(*number)));
}

std::string applySetting(const TfToken& key, const VtValue& value, HdPatinaSettings& settings) {
    const VtValue converted = settingValue(key, value);
    if (converted.IsEmpty()) {
        const Row* row = rowOf(key);
        const bool isNumber = row && !row->initial.IsHolding<std::string>() && numberOf(value);
        return isNumber ? "has a value that is not allowed; it is left as it was"
                        : "has a value of the wrong type; it is left as it was";
    }
    if (isMethod(key.GetString())) {
        const MethodChoices chosen = {
            {key.GetString().substr(7), converted.UncheckedGet<std::string>()}};
        if (const std::string problem = checkMethods(chosen); !problem.empty())
            return "is left as it was: " + problem;
        settings.methods[chosen.begin()->first] = chosen.begin()->second;
        return std::string();
    }
    if (!rowOf(key)->set(settings, converted))
        return "has a value that is not allowed; it is left as it was";
    return std::string();
}

} // namespace patina
