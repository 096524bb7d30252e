// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <cstdint>
#include <vector>

namespace patina {

/// Where a path comes to a surface, and the light that it finds there.
struct SharedPoint {
    static constexpr int mostDepth = 14;

    vec3 position{0.0f}; ///< world space
    vec3 side{0.0f};     ///< unit: the geometry's normal, on the side of the light
    vec3 normal{0.0f};   ///< unit: of the lobes, on the same side
    int depth = 0;       ///< surfaces before it: light of equal depth is missing beyond maxDepth
    float width = 0.0f;  ///< of the ray's cone, scene units
    vec3 light{0.0f};    ///< irradiance over pi
};

/// Means of what paths found in the same cell of space, on the same side of surfaces (Keller, Dahm
/// and Binder 2014, Path space filtering; Binder et al. 2018, Fast path space filtering by jittered
/// spatial hashing). Immutable; equal points give equal means.
class SharedLight {
public:
    /// Width of cells over that of cones, at most, in the first block.
    static constexpr float firstWidth = 0.5f;
    static constexpr int least = 8;   ///< points that have a mean
    static constexpr int wanted = 32; ///< points of a cell, where smaller cells have so many

    SharedLight() = default;
    /// @param scale widths of cells over those of cones, at most.
    SharedLight(const std::vector<SharedPoint>& points, float scale);

    /// @param at where light is asked for
    /// @param u moves the cell, so that its borders are no lines in an image; [0, 1)
    /// @returns whether enough points are there
    bool find(const SharedPoint& at, const vec2& u, vec3& light) const;

private:
    struct Cell {
        uint64_t key = 0; ///< 0: empty
        vec3 sum{0.0f};
        int count = 0;
    };

    /// The cells of one width that have enough points, as a hash table with open addresses.
    class Level {
    public:
        /// @param which of the points
        void add(const std::vector<SharedPoint>& points, const std::vector<uint32_t>& which,
                 float size);
        const Cell& at(const SharedPoint& point, float size, const vec2& u) const;

    private:
        size_t placeOf(uint64_t key) const;

        std::vector<Cell> _cells = std::vector<Cell>(1);
    };

    static constexpr int levelCount = 8; ///< each twice as wide as the one before

    /// The widest cells that a point may share light in; below 0: none
    int levelOf(const SharedPoint& point) const;
    float sizeOf(int level) const;

    std::vector<Level> _levels; ///< empty: there is no light
    float _scale = 0.0f;
    int _finest = 0; ///< the first level's cells are 2^_finest wide
};

} // namespace patina
