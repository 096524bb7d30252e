// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/settings.h"

#include <string>

namespace patina {

/// Choices of a Hydra host: render settings and back end.
struct HdPatinaSettings : RenderSettings {
    /// embree, raster, interactive (the rasterizer's image, refined by path tracing), or auto:
    /// interactive in interactive hosts where there is a GPU, else embree.
    std::string backend = "auto";
    bool denoise = false;     ///< show what Open Image Denoise makes of the colour
    bool denoiseAovs = false; ///< and of AOVs of light
};

/// The back end that makeBackend() shall make.
std::string backendOf(const HdPatinaSettings& settings);

} // namespace patina
