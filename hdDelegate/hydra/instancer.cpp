#include "hdDelegate/hydra/instancer.h"

#include "hdDelegate/hydra/instancerTransforms.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/tokens.h>

namespace patina {

HdPatinaInstancer::HdPatinaInstancer(HdSceneDelegate* delegate, const SdfPath& id)
    : HdInstancer(delegate, id) {}

void HdPatinaInstancer::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
                             HdDirtyBits* dirtyBits) {
    auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
    const SdfPath& id = GetId();
    _UpdateInstancer(delegate, dirtyBits);
    if (*dirtyBits == HdChangeTracker::Clean && _data) return;

    auto data = _data ? std::make_shared<HdPatinaInstanceData>(*_data)
                      : std::make_shared<HdPatinaInstanceData>();
    if (!_data || HdChangeTracker::IsTransformDirty(*dirtyBits, id) ||
        HdChangeTracker::IsAnyPrimvarDirty(*dirtyBits, id)) {
        data->transforms = readInstanceTransforms(*delegate, id, param);
        readPrimvars(*delegate, *data);
    }
    data->visible = delegate->GetVisible(id);
    data->categories.clear();
    for (const VtArray<TfToken>& names : delegate->GetInstanceCategories(id)) {
        data->categories.emplace_back();
        for (const TfToken& name : names)
            data->categories.back().push_back(name.GetString());
    }
    _group.clear();
    if (GetParentId().IsEmpty())
        param.instances().leave(id);
    else
        _group = param.instances().place(id, GetParentId(),
                                         delegate->GetInstanceIndices(GetParentId(), id));
    _data = data;
    param.instances().setInstancer(id, _group, _data);
    *dirtyBits = HdChangeTracker::Clean;
}

void HdPatinaInstancer::Finalize(HdRenderParam* renderParam) {
    static_cast<HdPatinaRenderParam*>(renderParam)->instances().removeInstancer(GetId());
}

void HdPatinaInstancer::readPrimvars(HdSceneDelegate& delegate, HdPatinaInstanceData& data) const {
    data.primvars.clear();
    for (const auto& descriptor :
         delegate.GetPrimvarDescriptors(GetId(), HdInterpolationInstance)) {
        if (TfStringStartsWith(descriptor.name.GetString(), "hydra:")) continue;
        Primvar primvar;
        primvar.name = descriptor.name.GetString();
        primvar.interpolation = Interpolation::Vertex;
        primvar.values = floatsOf(delegate.Get(GetId(), descriptor.name), primvar.components);
        if (primvar.components > 0 && primvar.components <= 16)
            data.primvars.push_back(std::move(primvar));
    }
}

} // namespace patina
