// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"

#include <map>
#include <string>
#include <vector>

namespace patina {

/// Numbers of the collections that lights and shadows are linked to. Immutable.
class LinkNames {
public:
    explicit LinkNames(const SceneState& state);

    /// @returns -1 for a name that no light is linked to
    int of(const std::string& name) const;
    /// Those of a prim's or an instance's categories that a light is linked to, ascending.
    std::vector<int> of(const std::vector<std::string>& categories) const;
    size_t size() const { return _numbers.size(); }
    bool operator==(const LinkNames& other) const { return _numbers == other._numbers; }

private:
    std::map<std::string, int> _numbers;
};

} // namespace patina
