// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <functional>
#include <vector>

namespace patina {

/// A sky as rough mirrors of GGX show it, seen from straight above (the first half of the split sum
/// of Karis 2013): the mean of the sky about a mirrored direction, weighted by D(h) and the cosine.
/// Right where the view is along the normal; towards grazing it lacks the stretch of highlights.
class PrefilteredSky {
public:
    static constexpr int width = 128, height = 64;
    static constexpr int levels = 5;
    /// Roughness (GGX alpha) of a level.
    static float alphaOf(int level);
    /// Where between the levels an alpha lies, 0..levels-1.
    static float levelOf(float alpha);

    PrefilteredSky() = default;
    explicit PrefilteredSky(const std::function<glm::vec3(const glm::vec3&)>& radiance);

    /// Rows from the pole down, as EnvironmentMap has latlong images.
    const std::vector<glm::vec4>& level(int i) const { return _levels[size_t(i)]; }
    /// The nearest texel's value.
    glm::vec3 at(const glm::vec3& direction, int level) const;

private:
    std::vector<glm::vec4> _levels[levels];
};

} // namespace patina
