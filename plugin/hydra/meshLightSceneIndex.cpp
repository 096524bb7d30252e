// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/meshLightSceneIndex.h"

#include <pxr/base/tf/diagnostic.h>
#include <pxr/imaging/hd/lightSchema.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>

PXR_NAMESPACE_OPEN_SCOPE

namespace {

const TfToken& childName() {
    static const TfToken name("light_of_mesh");
    return name;
}

SdfPath childOf(const SdfPath& mesh) {
    return mesh.AppendChild(childName());
}

bool isMeshLight(const HdSceneIndexPrim& prim) {
    if (prim.primType != HdPrimTypeTokens->mesh) return false;
    HdLightSchema light = HdLightSchema::GetFromParent(prim.dataSource);
    if (!light) return false;
    const auto flag = HdBoolDataSource::Cast(light.GetContainer()->Get(HdTokens->isLight));
    return flag && flag->GetTypedValue(0.0f);
}

} // namespace

HdPatinaMeshLightSceneIndex::HdPatinaMeshLightSceneIndex(const HdSceneIndexBaseRefPtr& input)
    : HdPatinaFilterSceneIndex(input) {
    populate(SdfPath::AbsoluteRootPath());
}

void HdPatinaMeshLightSceneIndex::populate(const SdfPath& path) {
    if (isMeshLight(_GetInputSceneIndex()->GetPrim(path))) addLight(path);
    for (const SdfPath& child : _GetInputSceneIndex()->GetChildPrimPaths(path))
        populate(child);
}

void HdPatinaMeshLightSceneIndex::addLight(const SdfPath& mesh) {
    _lights.insert(mesh);
    warnOfHidden(childOf(mesh));
}

void HdPatinaMeshLightSceneIndex::warnOfHidden(const SdfPath& child) {
    if (!isOfStage(child) || !_hidden.insert(child).second) return;
    TF_WARN("%s is hidden by the light of its mesh; give it another name", child.GetText());
}

bool HdPatinaMeshLightSceneIndex::isOfStage(const SdfPath& child) const {
    const HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(child);
    return prim.dataSource || !prim.primType.IsEmpty();
}

HdSceneIndexPrim HdPatinaMeshLightSceneIndex::GetPrim(const SdfPath& path) const {
    if (path.GetNameToken() != childName()) return _GetInputSceneIndex()->GetPrim(path);
    const SdfPath mesh = path.GetParentPath();
    HdSceneIndexPrim prim = _GetInputSceneIndex()->GetPrim(mesh);
    if (!isMeshLight(prim)) return _GetInputSceneIndex()->GetPrim(path);
    // The light stands where its mesh does, is instanced and hidden with it.
    prim.primType = HdPrimTypeTokens->meshLight;
    return prim;
}

SdfPathVector HdPatinaMeshLightSceneIndex::GetChildPrimPaths(const SdfPath& path) const {
    SdfPathVector children = _GetInputSceneIndex()->GetChildPrimPaths(path);
    if (_lights.count(path) &&
        std::find(children.begin(), children.end(), childOf(path)) == children.end())
        children.push_back(childOf(path));
    return children;
}

void HdPatinaMeshLightSceneIndex::_PrimsAdded(const HdSceneIndexBase&, const Added& entries) {
    Added added = entries;
    Removed removed;
    for (const auto& entry : entries) {
        const bool is = isMeshLight(_GetInputSceneIndex()->GetPrim(entry.primPath));
        if (entry.primPath.GetNameToken() == childName() &&
            _lights.count(entry.primPath.GetParentPath()))
            warnOfHidden(entry.primPath);
        if (is) {
            addLight(entry.primPath);
            added.emplace_back(childOf(entry.primPath), HdPrimTypeTokens->meshLight);
        } else if (_lights.erase(entry.primPath)) {
            removed.emplace_back(childOf(entry.primPath));
        }
    }
    if (!removed.empty()) _SendPrimsRemoved(removed);
    _SendPrimsAdded(added);
}

void HdPatinaMeshLightSceneIndex::_PrimsRemoved(const HdSceneIndexBase&, const Removed& entries) {
    // Removal takes descendants with it, the lights of meshes among them.
    for (const auto& entry : entries)
        for (std::set<SdfPath>* paths : {&_lights, &_hidden})
            for (auto it = paths->lower_bound(entry.primPath);
                 it != paths->end() && it->HasPrefix(entry.primPath);)
                it = paths->erase(it);
    _SendPrimsRemoved(entries);
}

void HdPatinaMeshLightSceneIndex::_PrimsDirtied(const HdSceneIndexBase&, const Dirtied& entries) {
    Dirtied dirtied = entries;
    Added added;
    Removed removed;
    for (const auto& entry : entries) {
        const bool was = _lights.count(entry.primPath) != 0;
        const bool maybe =
            was || entry.dirtyLocators.Intersects(HdLightSchema::GetDefaultLocator());
        if (!maybe) continue;
        const bool is = isMeshLight(_GetInputSceneIndex()->GetPrim(entry.primPath));
        const SdfPath child = childOf(entry.primPath);
        if (is && was) {
            dirtied.emplace_back(child, entry.dirtyLocators);
        } else if (is) {
            addLight(entry.primPath);
            added.emplace_back(child, HdPrimTypeTokens->meshLight);
        } else if (was) {
            _lights.erase(entry.primPath);
            removed.emplace_back(child);
        }
    }
    if (!removed.empty()) _SendPrimsRemoved(removed);
    if (!added.empty()) _SendPrimsAdded(added);
    _SendPrimsDirtied(dirtied);
}

PXR_NAMESPACE_CLOSE_SCOPE
