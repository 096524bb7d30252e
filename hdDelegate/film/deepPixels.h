// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace patina {

inline constexpr float deepBackground = 1e10f; ///< the depth of what is infinitely far away

/// Light that one ray of the camera has from one depth.
struct DeepEvent {
    float depth = deepBackground;
    bool inVolume = false;
    glm::vec3 color{0.0f};
    float alpha = 0.0f;
};

/// A sample of a deep image, as OpenEXR means it (Kainz, "Interpreting OpenEXR Deep Pixels"):
/// colour is multiplied by alpha; where back is greater than front, a volume fills what is between.
struct DeepSample {
    float front = 0.0f, back = 0.0f, alpha = 0.0f;
    glm::vec3 color{0.0f};
};

/// Deep pixels as they are sampled: the light and the coverage of each depth. Events at nearly one
/// depth are one sample; where there are more than the limit, neighbours are. Samples of a pixel do
/// not overlap, and add up to the pixel of the flat image whatever was merged. One thread writes
/// one pixel at a time.
class DeepPixels {
public:
    /// @param most samples of a pixel, 2 or more
    DeepPixels(int width, int height, int most);

    /// One ray of a pixel.
    void add(int x, int y, const DeepEvent* events, int count);
    /// Front to back.
    std::vector<DeepSample> resolve(int x, int y) const;

    int width() const { return _width; }
    int height() const { return _height; }

private:
    struct Bin {
        float front = 0.0f, back = 0.0f;
        bool inVolume = false;
        double alpha = 0.0;
        glm::dvec3 color{0.0};

        void add(const DeepEvent& event);
    };
    struct Cell {
        uint32_t rays = 0;
        std::vector<Bin> bins; ///< in the order of their depths
    };

    void insert(std::vector<Bin>& bins, const DeepEvent& event) const;
    static void mergeClosest(std::vector<Bin>& bins);

    int _width, _height;
    size_t _most;
    std::vector<Cell> _cells;
};

} // namespace patina
