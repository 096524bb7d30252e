// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace patina {

using Names = std::vector<std::string>;
using MethodNames = std::map<std::string, std::string>;
using PixelWindow = std::array<int, 4>;

inline constexpr PixelWindow allPixels = {0, 0, -1, -1};

/// How to render. Names and defaults are those that every host shows; settings.def has a row with
/// meaning, unit and range of each field.
struct RenderSettings {
#define SETTING(type, name, initial, ...) type name = initial;
#include "hdDelegate/scene/settings.def"
#undef SETTING

    bool operator==(const RenderSettings& other) const {
        return true
#define SETTING(type, name, ...) &&name == other.name
#include "hdDelegate/scene/settings.def"
#undef SETTING
            ;
    }
};

} // namespace patina
