// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// First looks: the first passes, in which neighbouring pixels use different samples of the lights,
/// and the result is smoothed over the surface (shaders/raster/firstLook.frag.glsl). Ordinary
/// passes, which converge, follow. The film holds the plain means, plus a share of the change that
/// smoothing makes. That share falls to 0, since smoothing is wrong where light or surface change
/// from pixel to pixel.
class RasterLook {
public:
    static constexpr int passes = 8;
    static constexpr uint32_t smoothed = 16; ///< passes after which nothing is
    static constexpr int bsdfSamples = 4;    ///< per pixel, where domes are

    /// @param error is set where the driver does not take the programs
    explicit RasterLook(std::string& error);
    bool ok() const { return bool(_program); }

    /// @returns false when the driver has no room
    bool resize(const GlTexture& color, const GlTexture& depth);
    /// The targets that surfaces are drawn into, in all passes: drivers compile a program anew for
    /// other targets.
    const GlFramebuffer& target() const { return _target; }
    void clear() const;
    /// Finds the difference that smoothing makes to what was drawn.
    void smooth() const;
    const GlFramebuffer& difference() const { return _differenceTarget; }
    const GlTexture& differenceImage() const { return _difference; }
    void read(std::vector<glm::vec4>& pixels, GlDownload& download) const;

    /// The share of what smoothing does that a film of so many passes has.
    static float share(uint32_t passes) {
        return passes >= smoothed ? 0.0f
                                  : std::min(1.0f, float(smoothed - passes) / float(smoothed - 4));
    }

    /// The share of a first image of many samples that a film of so many passes shows.
    static float shareOfFirst(uint32_t passes) {
        if (passes >= smoothed) return 0.0f;
        const float late = float(smoothed - passes) / float(smoothed - 1);
        return late * 3.0f / (float(passes) + 2.0f); // it is worth some three passes
    }

private:
    std::unique_ptr<GlProgram> _program;
    GlTexture _noisy, _guide, _place, _normal, _difference;
    GlFramebuffer _target, _differenceTarget;
};

} // namespace patina
