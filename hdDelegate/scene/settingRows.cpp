// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/settingRows.h"

#include <algorithm>
#include <sstream>
#include <type_traits>

namespace patina {

SettingRow& SettingRow::choices(const char* names) {
    std::istringstream stream(names);
    for (std::string name; stream >> name;)
        allowed.push_back(name);
    return *this;
}

bool SettingRow::takes(const std::string& value) const {
    return allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end();
}

double SettingRow::number(const RenderSettings& settings) const {
    return std::visit(
        [&](auto field) {
            if constexpr (std::is_arithmetic_v<std::decay_t<decltype(settings.*field)>>)
                return double(settings.*field);
            else
                return 0.0;
        },
        member);
}

const std::vector<SettingRow>& settingRows() {
    static const std::vector<SettingRow> rows = [] {
        std::vector<SettingRow> made;
        const double most = std::numeric_limits<double>::infinity();
        const double None = 0.0; // of flags, which are not read here
        const auto row = [](const char* name, SettingRow::Member member) {
            SettingRow r;
            r.name = name;
            r.member = member;
            return r;
        };
#define SETTING(type, name, initial, ...)                                                          \
    made.push_back(row(#name, &RenderSettings::name) __VA_ARGS__);
#include "hdDelegate/scene/settings.def"
#undef SETTING
        return made;
    }();
    return rows;
}

} // namespace patina
