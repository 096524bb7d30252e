// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/instancer.h"

#include "hdDelegate/hydra/instancerTransforms.h"
#include "hdDelegate/hydra/marks.h"
#include "hdDelegate/hydra/primvars.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/tokens.h>

namespace patina {

namespace {

std::vector<std::string> textsOf(const VtArray<TfToken>& names) {
    std::vector<std::string> texts;
    for (const TfToken& name : names)
        texts.push_back(name.GetString());
    return texts;
}

/// Links to a point instancer are links to all of its `count` instances.
std::vector<std::vector<std::string>> instanceCategories(HdSceneDelegate& delegate,
                                                         const SdfPath& id, size_t count) {
    std::vector<std::vector<std::string>> categories;
    for (const VtArray<TfToken>& names : delegate.GetInstanceCategories(id))
        categories.push_back(textsOf(names));
    if (!categories.empty()) return categories;
    const std::vector<std::string> own = textsOf(delegate.GetCategories(id));
    if (!own.empty()) categories.assign(count, own);
    return categories;
}

} // namespace

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
        HdChangeTracker::IsAnyPrimvarDirty(*dirtyBits, id))
        readInstances(*delegate, param, *data);
    data->visible = delegate->GetVisible(id);
    data->categories = instanceCategories(*delegate, id, data->transforms.size());
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _data = data;
    }
    place(param);
    *dirtyBits = HdChangeTracker::Clean;
}

void HdPatinaInstancer::place(HdPatinaRenderParam& param) {
    std::lock_guard<std::mutex> lock(_mutex);
    std::string group;
    if (GetParentId().IsEmpty())
        param.instances().leave(GetId());
    else
        group = param.instances().place(GetId(), GetParentId(),
                                        GetDelegate()->GetInstanceIndices(GetParentId(), GetId()));
    if (!_data || (_data == _placed && group == _group)) return;
    _group = group;
    _placed = _data;
    param.instances().setInstancer(GetId(), _group, _data);
}

void HdPatinaInstancer::updateCategories(HdPatinaRenderParam& param) {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_data) return;
        auto categories = instanceCategories(*GetDelegate(), GetId(), _data->transforms.size());
        if (categories == _data->categories) return;
        auto data = std::make_shared<HdPatinaInstanceData>(*_data);
        data->categories = std::move(categories);
        _data = data;
    }
    place(param);
}

void HdPatinaInstancer::updateColors(HdPatinaRenderParam& param) {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_data) return;
        auto data = std::make_shared<HdPatinaInstanceData>(*_data);
        readPrimvars(*GetDelegate(), param, *data);
        _data = data;
    }
    place(param);
}

void HdPatinaInstancer::updateTransforms(HdPatinaRenderParam& param) {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_data || _shutter == param.shutter()) return;
        auto data = std::make_shared<HdPatinaInstanceData>(*_data);
        readInstances(*GetDelegate(), param, *data);
        _data = data;
    }
    place(param);
}

void HdPatinaInstancer::Finalize(HdRenderParam* renderParam) {
    static_cast<HdPatinaRenderParam*>(renderParam)->instances().removeInstancer(GetId());
}

void HdPatinaInstancer::readInstances(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                      HdPatinaInstanceData& data) {
    _shutter = param.shutter();
    data.transforms = readInstanceTransforms(delegate, GetId(), param);
    readPrimvars(delegate, param, data);
}

void HdPatinaInstancer::readPrimvars(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                     HdPatinaInstanceData& data) const {
    const size_t instances = data.transforms.size();
    data.primvars.clear();
    data.marks = marksOfInstances(delegate, param, GetId(), instances);
    if (instances == 0) return; // nothing is drawn, and readInstanceTransforms() has said why
    for (const auto& descriptor :
         delegate.GetPrimvarDescriptors(GetId(), HdInterpolationInstance)) {
        Primvar primvar;
        primvar.name = descriptor.name.GetString();
        if (TfStringStartsWith(primvar.name, "hydra:") || isMark(primvar.name)) continue;
        primvar.interpolation = Interpolation::Vertex;
        const VtValue value = delegate.Get(GetId(), descriptor.name);
        primvar.values = floatsOf(value, primvar.components);
        if (primvar.components < 1 || primvar.components > 16) {
            warnOfType(param, GetId(), primvar.name, value);
            continue;
        }
        const size_t count = primvar.values.size() / size_t(primvar.components);
        if (count != instances)
            param.warn(GetId(), "primvars:" + primvar.name,
                       messages::instanceValuesLeftOut(count, instances));
        else {
            toRenderingSpace(delegate, param, GetId(), descriptor, primvar);
            data.primvars.push_back(std::move(primvar));
        }
    }
}

} // namespace patina
