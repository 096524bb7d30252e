// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/passes/rasterFilterSplat.h"
#include "hdDelegate/raster/samples/lightSampler.h"

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// What a pass of a preview takes of the lights.
class PreviewSampler : public LightSampler {
public:
    using LightSampler::LightSampler;

    /// Many samples of each light, of which every pixel takes others than its neighbours, so that
    /// what is wrong is noise and not the same everywhere.
    /// @param maximum shadow maps that may be drawn; where they do not suffice, lights are as in
    /// sample()
    /// @param most as in sample()
    SampledLights samplePreview(int maximum, int most) const;
    /// For the first image where maps are too dear for that: light by as many samples, shadows of
    /// domes by the cells of the sky, and of other lights by the maps of few of their samples. It
    /// is not right in the mean where there are shadows, so nothing of it may stay.
    /// @returns nothing taken where there is no room even for that
    SampledLights sampleFirst(int maximum) const;

private:
    struct Parts;
    int samplesOf(const RasterLightSource& source, int pooled) const;
    /// @param mapped samples that have shadow maps of their own
    void add(size_t source, int samples, int mapped, int maximum, Parts& parts) const;
};

/// First looks: the first passes, in which neighbouring pixels use different samples of the lights,
/// and the result is smoothed over the surface (shaders/raster/smoothPreview.frag.glsl). Ordinary
/// passes, which converge, follow. The film holds the plain means, plus a share of the change that
/// smoothing makes. That share falls to 0, since smoothing is wrong where light or surface change
/// from pixel to pixel.
class PreviewPasses {
public:
    static constexpr int passes = 8;
    static constexpr uint32_t smoothed = 16; ///< passes after which nothing is
    static constexpr int bsdfSamples = 4;    ///< per pixel, where domes are

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

    /// Adds a pass to a film.
    /// @param pixels of the pass; overwritten
    /// @param preview whether the pass is one of those that are smoothed
    /// @param first it is a sampleFirst(), which shows until the mean of later passes is better
    /// @param window pixels of the film: xmin, ymin, xmax, ymax, inclusive
    void add(std::vector<vec4>& pixels, const RasterSample& sample, bool preview, bool first,
             const int* window, GlDownload& download, Film& film);

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
    void mixFirst(std::vector<vec4>& pixels, const RasterSample& sample, const int* window,
                  Film& film);
    void addSmoothing(std::vector<vec4>& difference, const RasterSample& sample, const int* window,
                      Film& film);

    std::unique_ptr<GlProgram> _program = GlProgram::own("background", "smoothPreview");
    GlTexture _noisy, _guide, _place, _normal, _difference;
    GlFramebuffer _target, _differenceTarget;
    // By pixel of the film:
    std::vector<vec4> _first, _sums; ///< a first image, and the passes after it
    std::vector<vec4> _smoothing;    ///< what it does to the sums
};

} // namespace patina
