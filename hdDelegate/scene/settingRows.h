// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/settings.h"

#include <limits>
#include <variant>

namespace patina {

/// One row of settings.def.
struct SettingRow {
    using Member =
        std::variant<bool RenderSettings::*, int RenderSettings::*, uint32_t RenderSettings::*,
                     float RenderSettings::*, double RenderSettings::*,
                     std::string RenderSettings::*, Names RenderSettings::*,
                     MethodNames RenderSettings::*, PixelWindow RenderSettings::*>;

    std::string name;
    Member member;
    std::string shown;     ///< to users of hosts; empty where hosts do not have it
    std::string hydraName; ///< Hydra's own name; mostly empty
    Names allowed;         ///< texts; empty: any
    double least = -std::numeric_limits<double>::infinity();
    double largest = std::numeric_limits<double>::infinity();
    double besides = std::numeric_limits<double>::quiet_NaN(); ///< also taken
    bool ofLights = false;                                     ///< LightsKey compares it

    /// NaN is not taken where there is a range.
    bool takes(double value) const {
        return (value >= least && value <= largest) || value == besides;
    }
    bool takes(const std::string& value) const;
    double number(const RenderSettings& settings) const; ///< of a switch 0 or 1, of a text 0

    // The words of settings.def.
    SettingRow& range(double from, double to) {
        least = from;
        largest = to;
        return *this;
    }
    SettingRow& also(double value) {
        besides = value;
        return *this;
    }
    SettingRow& choices(const char* names);
    SettingRow& label(const char* text) {
        shown = text;
        return *this;
    }
    SettingRow& hydra(const char* text) {
        hydraName = text;
        return *this;
    }
    SettingRow& changesLights() {
        ofLights = true;
        return *this;
    }
    // Only plugin/patina/cli reads these.
    SettingRow& resumes() { return *this; }
    SettingRow& flag(const char*, const char*) { return *this; }
    SettingRow& flagOn(const char*, const char*) { return *this; }
    SettingRow& flagOff(const char*, const char*) { return *this; }
    SettingRow& flagRange(double, double) { return *this; }
    SettingRow& flagAbove(double) { return *this; }
    SettingRow& flagSize() { return *this; }
    SettingRow& flagDefault(double) { return *this; }
    SettingRow& group(const char*) { return *this; }
};

/// All of them, in the order in which users see them.
const std::vector<SettingRow>& settingRows();

} // namespace patina
