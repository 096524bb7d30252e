// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

namespace patina {

/// Where the light of one ray of the camera comes from, for deep images. All that a ray gathers
/// belongs to the place where it ends: the first surface, light or collision that it meets. What
/// glows before that, and lets the ray pass, keeps its own light.
class DeepRay {
public:
    /// The ray goes on past a place.
    /// @param radiance of the path so far
    void pass(float depth, const glm::vec3& radiance, bool inVolume = false) {
        if (radiance == _told) return;
        DeepEvent& event = _events[_count < most - 1 ? _count++ : most - 2];
        event.depth = depth;
        event.inVolume = inVolume;
        event.color += radiance - _told;
        _told = radiance;
    }
    void end(float depth, bool inVolume = false) {
        _depth = depth;
        _inVolume = inVolume;
    }

    /// Adds it to a pixel.
    /// @param radiance,alpha of the whole path
    /// @param scale of the image
    /// @param usable otherwise its light counts as black, as in the film
    void write(DeepPixels& pixels, int x, int y, const glm::vec3& radiance, float alpha,
               float scale, bool usable) {
        DeepEvent& last = _events[_count++];
        last.depth = _depth;
        last.inVolume = _inVolume;
        last.color = radiance - _told;
        last.alpha = alpha >= 0.0f && alpha <= 1.0f ? alpha : 0.0f;
        for (int i = 0; i < _count; ++i)
            _events[i].color = usable ? _events[i].color * scale : glm::vec3(0.0f);
        pixels.add(x, y, _events, _count);
    }

private:
    static constexpr int most = 8;
    DeepEvent _events[most];
    int _count = 0;
    glm::vec3 _told{0.0f}; ///< of the radiance: what events have
    float _depth = deepBackground;
    bool _inVolume = false;
};

} // namespace patina
