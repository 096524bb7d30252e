#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/instances.h"

#include <pxr/imaging/hd/instancer.h>

namespace patina {

/// Point instancers and native instances, nested. Rotations of every type that scene delegates have
/// used are understood: quath, quatf, quatd, and vec4 (real part first).
class HdPatinaInstancer final : public HdInstancer {
public:
    HdPatinaInstancer(HdSceneDelegate* delegate, const SdfPath& id);

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
              HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

private:
    void readPrimvars(HdSceneDelegate& delegate, HdPatinaInstanceData& data) const;

    std::shared_ptr<const HdPatinaInstanceData> _data;
    std::string _group;
};

} // namespace patina
