// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

#include <pxr/imaging/hd/basisCurves.h>

namespace patina {

/// Curves of every type, basis and wrap; ribbons where they have normals, tubes elsewhere. Also
/// NURBS and Hermite curves, which UsdImaging hands on as straight lines between their points.
class HdPatinaBasisCurves final : public HdPatinaGprim<HdBasisCurves, Curves> {
public:
    using HdPatinaGprim::HdPatinaGprim;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Curves& curves) override;
    void setPoints(Curves& curves, Sampled<std::vector<vec3>> points) override;
    std::shared_ptr<const Geometry>
    shownAs(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
            const std::shared_ptr<const Curves>& curves) const override;

private:
    void expandPoints(HdPatinaRenderParam& param, Curves& curves) const;

    std::vector<int> _indices;          ///< into the points; empty: they are in order
    Sampled<std::vector<vec3>> _points; ///< as authored, with _indices
    bool _isLines = false;              ///< pairs of points, as stand-ins of models have
    bool _isStale = false;              ///< these have changed since the curves were made of them
};

} // namespace patina
