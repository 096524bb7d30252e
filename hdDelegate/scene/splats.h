// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

namespace patina {

/// Particles as a UsdVolParticleField3DGaussianSplat has them. An array holds nothing, which stands
/// for the fallback of the schema, or as many elements as there are particles.
struct SplatCloud {
    std::vector<vec3> positions;
    std::vector<vec4> orientations; ///< quaternions, the real part first; fallback: not turned
    std::vector<vec3> scales;       ///< standard deviations along the kernels' axes; fallback: 1
    std::vector<float> opacities;   ///< at the kernels' middles; fallback: 1
    int degree = 3;                 ///< of the harmonics
    /// (degree + 1)^2 for each particle, from the lowest band to the highest; fallback: grey of 0.5.
    std::vector<vec3> harmonics;

    size_t stride() const { return size_t(degree + 1) * size_t(degree + 1); }
};

/// A field of Gaussian kernels with their captured radiance.
struct Splats : Geometry {
    std::shared_ptr<const SplatCloud> cloud = std::make_shared<const SplatCloud>();
    std::string colorSpace; ///< of the radiance; empty: linear Rec.709

    Splats() { kind = GeometryKind::Splats; }
};

/// Puts an authored cloud into a prim: arrays get the length that they need, as UsdVol's schema
/// says, or are dropped. Particles that cannot be drawn get the opacity 0. Warns of what is wrong.
void setCloud(Splats& prim, SplatCloud cloud, Diagnostics& diagnostics);

} // namespace patina
