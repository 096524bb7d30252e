// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/lights/skyHarmonics.h"

#include <map>
#include <memory>
#include <vector>

namespace patina {

/// The images of domes as textures, one layer each. Kept from one build of the lights to the next;
/// what stays the same is not made again.
class RasterDomes {
public:
    static constexpr int densityWidth = 512;
    static constexpr int maxImages = 256;                ///< five layers each where prefiltered
    static constexpr size_t maxTexels = size_t(1) << 27; ///< of all images; beyond, each is smaller

    void begin() { _wanted.clear(); }
    /// @returns the layer of an image; -1: there are maxImages already
    int layer(const std::shared_ptr<const EnvironmentMap>& map);
    const SkyHarmonics& harmonics(const std::shared_ptr<const EnvironmentMap>& map);
    /// Makes the textures of all layers since begin().
    /// @param prefiltered those of PrefilteredSky too
    void upload(bool prefiltered);

    const GlTexture& maps() const { return _maps; } ///< empty where no dome has an image
    const GlTexture& densities() const { return _densities; }
    const GlTexture& prefiltered() const { return _prefiltered; } ///< levels of a dome in a row

private:
    void uploadPrefiltered();

    using Maps = std::vector<std::shared_ptr<const EnvironmentMap>>;
    Maps _wanted, _uploaded, _filtered;
    std::map<std::shared_ptr<const EnvironmentMap>, SkyHarmonics> _harmonics;
    GlTexture _maps, _densities, _prefiltered;
};

} // namespace patina
