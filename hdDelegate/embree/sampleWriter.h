// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/aovWriter.h"
#include "hdDelegate/embree/lightPathRecord.h"
#include "hdDelegate/embree/path.h"

namespace patina {

/// Writes what a sample of a pixel shows to the film: colour, AOVs, guides of the denoiser, light
/// paths and deep pixels.
class SampleWriter {
public:
    /// @param filterRadius of the pixel filter, for splats
    SampleWriter(const std::vector<AovSpec>& aovs, const CameraRays& camera, float filterRadius);

    const std::vector<AovSpec>& aovs() const { return _aovs; }
    const LightPathAovs& lightPaths() const { return _lightPaths; }
    /// Whether samples count for other pixels too.
    bool splats() const { return _quarterColors >= 0 && _quarterShares >= 0; }
    /// Random numbers of a sample. Where the film has half of the samples apart, both halves have
    /// numbers of their own.
    Sampler sampler(int x, int y, uint32_t seed, uint32_t index) const;

    /// AOVs and guides get what they show of a vertex.
    void show(Path& path, const SurfacePoint& point, const Bsdf& bsdf,
              const AovTarget& target) const;
    /// A path that has ended.
    void write(const Path& path, const AovTarget& target, const vec3& origin) const;
    /// A sample of a pixel that sees nothing at all, through the edge of a fisheye, say.
    void writeDark(const AovTarget& target) const;
    /// A sample of one grey. @param seen less than 0: nothing is there
    void writeGrey(float seen, float depth, const AovTarget& target) const;

private:
    /// Guides are of every sample, so that means fade at outlines as the colour does.
    void add(const vec3& color, float alpha, const vec3& albedo, const vec3& normal,
             const AovTarget& target) const;

    /// What the denoiser asks for: places in the film, or -1.
    struct Denoising {
        int color = -1, albedo = -1, normal = -1;
        void add(Film& film, int x, int y, const vec3& c, const vec3& a, const vec3& n) const;
    };

    const std::vector<AovSpec> _aovs;
    const CameraRays& _camera;
    const LightPathAovs _lightPaths;
    Denoising _all, _half;
    const float _filterRadius;
    int _quarterColors = -1, _quarterShares = -1;
};

} // namespace patina
