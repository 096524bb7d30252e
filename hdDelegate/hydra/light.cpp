// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/light.h"

#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/lightFilter.h"
#include "hdDelegate/hydra/lightParams.h"
#include "hdDelegate/hydra/sampling.h"

#include <pxr/imaging/hd/instancer.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/tokens.h>

namespace patina {

namespace {

/// A dome that does not stand on +Y is turned first.
MotionTransform placeOf(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id) {
    const VtValue turn = delegate.GetLightParamValue(id, TfToken("domeOffset"));
    return transformOf(delegate, param, id, turn.GetWithDefault(GfMatrix4d(1.0)));
}

} // namespace

void HdPatinaLight::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
                         HdDirtyBits* dirtyBits) {
    auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
    const SdfPath& id = GetId();
    _UpdateInstancer(delegate, dirtyBits);
    if (*dirtyBits == Clean && _light) return;

    const bool all = !_light;
    auto light = all ? std::make_shared<Light>() : std::make_shared<Light>(*_light);
    light->path = id.GetString();
    _delegate = delegate;
    if (all || (*dirtyBits & DirtyTransform)) {
        _shutter = param.shutter();
        light->transform = placeOf(*delegate, param, id);
    }
    // Hosts mark params dirty for visibility, collections and resources alike.
    if (all || (*dirtyBits & ~HdDirtyBits(DirtyTransform)))
        readLightParams(*delegate, param, id, _type, *light);
    if (GetInstancerId().IsEmpty()) {
        param.instances().leave(id);
        light->group.clear();
    } else {
        HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), GetInstancerId());
        light->group = param.instances().place(id, GetInstancerId(),
                                               delegate->GetInstanceIndices(GetInstancerId(), id));
    }
    const bool links = !light->lightLink.empty() || !light->shadowLink.empty();
    const bool linked = _light && (!_light->lightLink.empty() || !_light->shadowLink.empty());
    if ((all || (*dirtyBits & (DirtyCollection | DirtyParams))) && (links || linked))
        param.setLinksChanged(); // of any number of lights the prims are read once: readAgain()
    _light = light;
    if (_light->visible)
        param.set(_light);
    else
        param.removeLight(light->path);
    *dirtyBits = Clean;
}

void HdPatinaLight::updateTransform(HdPatinaRenderParam& param) {
    if (!_light || _shutter == param.shutter()) return;
    _shutter = param.shutter();
    auto light = std::make_shared<Light>(*_light);
    light->transform = placeOf(*_delegate, param, GetId());
    _light = light;
    if (_light->visible) param.set(_light);
}

void HdPatinaLight::updateParams(HdPatinaRenderParam& param) {
    if (!_light) return;
    auto light = std::make_shared<Light>(*_light);
    readLightParams(*_delegate, param, GetId(), _type, *light);
    _light = light;
    if (_light->visible) param.set(_light);
}

void HdPatinaLight::updateFilters(HdPatinaRenderParam& param) {
    if (!_light) return;
    auto light = std::make_shared<Light>(*_light);
    light->filters = readLightFilters(*_delegate, param, GetId());
    _light = light;
    if (_light->visible) param.set(_light);
}

void HdPatinaLight::Finalize(HdRenderParam* renderParam) {
    auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
    param.instances().leave(GetId());
    param.removeLight(GetId().GetString());
}

} // namespace patina
