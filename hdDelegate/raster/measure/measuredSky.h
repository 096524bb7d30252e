// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/raster/lights/prefilteredSky.h"
#include "hdDelegate/raster/lights/skyHarmonics.h"
#include "hdDelegate/raster/measure/skyTexture.h"

#include <memory>
#include <string>
#include <vector>

namespace patina::measure {

/// A sky with all that the methods of the choice point domeLight make of it when they load it. Its
/// mean radiance is 1, so that errors are relative to a sky's light.
struct MeasuredSky {
    static constexpr int width = 256, height = 128;

    /// A texel of the image, its light on what faces it.
    struct Texel {
        glm::vec3 direction;
        float flux;
    };
    /// A direction by the sky's density.
    struct Drawn {
        glm::vec3 direction;
        float density, radiance;
    };

    std::string name;
    EnvironmentMap map;
    SkyTexture image, density;
    std::vector<SkyTexture> prefiltered; ///< one level of PrefilteredSky each
    SkyHarmonics harmonics, bare;        ///< bare: no dominant light apart, no window
    std::vector<Texel> texels;
    std::vector<Drawn> drawn; ///< 4096 of them, evenly spread (Owen-scrambled Sobol points)

    float radiance(const glm::vec3& d) const { return map.radiance(d).x; }
    /// As domePdf() of shaders/raster/lights.glsl.
    float densityAt(const glm::vec3& d, float lod) const;

    /// The same from all sides.
    static MeasuredSky constant();
    /// Clouds: a horizon, a brighter zenith and a broad glow.
    static MeasuredSky soft();
    /// A clear one: a smooth gradient over a dark ground, and a sun four degrees wide that gives
    /// five sixths of all light.
    static MeasuredSky sun();

private:
    MeasuredSky(const char* name, std::shared_ptr<const ImageRGB> sky);
};

} // namespace patina::measure
