// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/lights/rasterLights.h"
#include "hdDelegate/raster/samples/lightCells.h"
#include "hdDelegate/raster/scene/rasterEmitters.h"
#include "hdDelegate/raster/shadows/rasterShadows.h"

namespace patina {

/// The lights as a pass knows them.
struct SampledLights {
    std::vector<GpuLight> lights; ///< taken ones first, then those that are only looked at
    int taken = 0;
    std::vector<vec4> tables; ///< see RasterLightTables::writePass()
    ShadowPlan shadows;
    /// Which lights are for what, see passFields.glsl.
    int found = 0, firstSampled = 0, firstShared = 0, sharedEvery = 1;
    /// Where pixels choose among the lights from firstShared on: of those, by their numbers.
    std::vector<LightEstimate> estimates;
    bool many = false; ///< of a preview: all lights have as many samples as help
};

/// What one pass takes of the lights: one sample of each (more of domes). All pixels share the
/// samples, so a shadow map can tell which points a sample reaches. Passes add up to soft shadows.
/// If a pass has no room for the shadow maps of all lights, it takes some of the lights. These
/// count more, so that the mean of the passes is right.
class LightSampler {
public:
    static constexpr int minEmitterSamples = 2; ///< of all glowing triangles together
    static constexpr int maxEmitterSamples = 5; ///< where lights leave room for their shadows
    static constexpr int chosen = 4;            ///< by a pixel, where pixels choose among lights
    static constexpr int maxUnshadowed = 64;    ///< lights without shadows
    static constexpr int maxDomes = 24;
    static constexpr int maxTaken = 208; ///< samples, see Lights in lights.glsl

    /// All have to outlive it.
    /// @param mapSize of shadow maps, when there are not too many
    /// @param pixels along the longer side of the image
    LightSampler(const RasterLights& lights, const RasterEmitters& emitters,
                 const ShadowBounds& bounds, int mapSize, int pixels, uint32_t pass)
        : _lights(lights), _sources(lights.sources()), _emitters(emitters), _bounds(bounds),
          _mapSize(mapSize), _pixels(pixels), _pass(pass) {}

    /// @param most shadow maps that may be drawn where pixels choose among lights
    SampledLights sample(int most = ShadowPlan::maxSmallMaps) const;

protected:
    /// Numbers of one set. Sets are scrambled apart from each other and from those of
    /// rasterRenderer.cpp, so that no light's samples go with the pixels' offsets.
    vec2 twoNumbers(uint32_t index, uint32_t set) const;
    /// The same with a third number, stratified together with them.
    vec3 threeNumbers(uint32_t index, uint32_t set) const;
    /// The sets of a source are this and the next.
    static uint32_t setOf(size_t source) { return 100 + 16 * uint32_t(source); }
    /// The shadow maps that samples of a light need at most; see ShadowPlan::cast().
    int mapsOf(const RasterLightSource& source, const ShadowBounds& bounds) const;
    /// Gives a sample its maps, where it casts shadows.
    /// @param index of its numbers
    void cast(GpuLight& sample, size_t source, uint32_t index, int maximum,
              ShadowPlan& shadows) const;
    /// @param to gets the samples, `out` their tables and maps
    void takeEmitters(int samples, int maximum, SampledLights& out,
                      std::vector<GpuLight>& to) const;

    const RasterLights& _lights;
    const std::vector<RasterLightSource>& _sources;
    const RasterEmitters& _emitters;
    const ShadowBounds& _bounds;
    const int _mapSize, _pixels;
    const uint32_t _pass;

private:
    /// @returns index of the source and how often it counts
    std::vector<std::pair<size_t, float>> choose(int room, int emitterSamples) const;
    /// @param placed samples of lights at places, with their sources
    void choosePerPixel(const std::vector<std::pair<GpuLight, size_t>>& placed,
                        SampledLights& out) const;
};

} // namespace patina
