// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/lights/lightEstimate.h"

#include <cstdint>
#include <vector>

namespace patina {

/// Cells of space with short lists of many lights, from which shaders/raster/manyLights.glsl
/// chooses (after Boksansky, Jukarainen and Wyman 2021, Rendering Many Lights with Grid-Based
/// Reservoirs). A light is in the list of a cell with a probability that grows with what it sends
/// there, and then counts as often as makes the mean over many lists right. A list with room for
/// all lights holds all.
struct LightCells {
    static constexpr int listed = 16; ///< entries of a list
    static constexpr int maxCells = 4096;
    static constexpr int aRow = 64; ///< cells in a row of the texture
    static constexpr int rows = maxCells / aRow;
    static constexpr float even = 0.1f; ///< share of a list's chances that all lights have alike

    vec3 low{0.0f}, perUnit{0.0f};
    ivec3 sides{1};
    /// Cell after cell, the first along x: how often a light counts, the last eight bits its
    /// number.
    std::vector<uint32_t> lists;

    /// @param estimates by the numbers of lights, of which there are at most 256
    /// @param first of the lights that are chosen among
    /// @param low,high of all that is lit
    LightCells(const std::vector<LightEstimate>& estimates, size_t first, vec3 low, vec3 high,
               uint32_t seed, uint32_t pass);
    LightCells() = default;
};

/// What shaders/raster/manyLights.glsl reads, on the GPU. Lives with one context.
class RasterManyLights {
public:
    /// Uploads what a pass needs, unless it is that of the pass before, and binds it: 5 of uniform
    /// blocks, 26 of textures.
    /// @param estimates,first,low,high,seed,pass as of LightCells
    /// @param lights that the shaders have room for
    const LightCells& bind(const std::vector<LightEstimate>& estimates, size_t first, vec3 low,
                           vec3 high, uint32_t seed, uint32_t pass, size_t lights);

private:
    void upload(size_t lights);

    std::vector<LightEstimate> _of; ///< what _cells are made of
    size_t _first = 0;
    vec3 _low{0.0f}, _high{0.0f};
    uint32_t _seed = 0, _pass = 0;
    LightCells _cells;
    GlBuffer _estimates;
    GlTexture _lists;
};

} // namespace patina
