// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

#include <pxr/imaging/hd/points.h>

namespace patina {

/// Points: spheres, or disks where they have normals.
class HdPatinaPoints final : public HdPatinaGprim<HdPoints, Points> {
public:
    using HdPatinaGprim::HdPatinaGprim;

protected:
    void syncShape(HdSceneDelegate&, HdPatinaRenderParam&, HdDirtyBits, bool, const TfToken&,
                   Points&) override {}
    void setPoints(Points& points, Sampled<std::vector<vec3>> values) override {
        points.points = std::move(values);
    }
};

} // namespace patina
