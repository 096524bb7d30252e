// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/linkNames.h"

#include <algorithm>

namespace patina {

LinkNames::LinkNames(const SceneState& state) {
    for (const auto& item : state.lights)
        for (const std::string& link : {item.second->lightLink, item.second->shadowLink})
            if (!link.empty()) _numbers.emplace(link, int(_numbers.size()));
}

int LinkNames::of(const std::string& name) const {
    const auto found = _numbers.find(name);
    return found == _numbers.end() ? -1 : found->second;
}

std::vector<int> LinkNames::of(const std::vector<std::string>& categories) const {
    std::vector<int> numbers;
    for (const std::string& name : categories)
        if (const int number = of(name); number >= 0) numbers.push_back(number);
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

} // namespace patina
