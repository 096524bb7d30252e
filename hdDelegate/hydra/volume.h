// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

#include <pxr/imaging/hd/field.h>
#include <pxr/imaging/hd/volume.h>

namespace patina {

/// Types of fields that volumes can be made of: those of OpenVDB files.
const TfTokenVector& fieldTypes();

/// A field of a volume. Volumes read what it says in their own sync; it tells them when that
/// changed.
class HdPatinaField final : public HdField {
public:
    using HdField::HdField;

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
};

/// A volume of OpenVDB fields.
class HdPatinaVolume final : public HdPatinaGprim<HdVolume, Volume> {
public:
    using HdPatinaGprim::HdPatinaGprim;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Volume& volume) override;
    void setPoints(Volume&, Sampled<std::vector<vec3>>) override {}
};

} // namespace patina
