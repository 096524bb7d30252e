// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

namespace patina {

/// Hydra's name of them, which releases before 26.03 do not have.
const TfToken& splatsType();

/// A field of particles. Hydra hands on the primvars of UsdVol's ParticleField3DGaussianSplat, but
/// neither which kernels the particles have nor the colour space of their radiance.
class HdPatinaSplats final : public HdPatinaGprim<HdRprim, Splats> {
public:
    using HdPatinaGprim::HdPatinaGprim;

    const TfTokenVector& GetBuiltinPrimvarNames() const override;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Splats& splats) override;
    void setPoints(Splats&, Sampled<std::vector<vec3>>) override {}
};

} // namespace patina
