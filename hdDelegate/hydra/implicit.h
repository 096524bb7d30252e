// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

namespace patina {

/// Spheres, cubes, cones, cylinders, capsules and planes as they are, where the host gives them as
/// such (scene indices do; scene delegates turn them into meshes themselves).
class HdPatinaImplicit final : public HdPatinaGprim<HdRprim, Implicit> {
public:
    HdPatinaImplicit(const TfToken& type, const SdfPath& id);

    const TfTokenVector& GetBuiltinPrimvarNames() const override;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Implicit& shape) override;
    void setPoints(Implicit&, Sampled<std::vector<vec3>>) override {}

private:
    TfToken _type;
};

} // namespace patina
