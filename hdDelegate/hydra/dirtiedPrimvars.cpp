// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/dirtiedPrimvars.h"

#include <pxr/imaging/hd/primvarsSchema.h>

namespace patina {

bool HdPatinaDirtiedPrimvars::take(const SdfPath& prim, std::set<std::string>& names) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto found = _prims.find(prim);
    if (found == _prims.end()) return false;
    names = std::move(found->second.names);
    const bool known = !found->second.all && !names.empty();
    _prims.erase(found);
    return known;
}

void HdPatinaDirtiedPrimvars::PrimsAdded(const HdSceneIndexBase&, const AddedPrimEntries& entries) {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const AddedPrimEntry& entry : entries) // also of prims that were there, and changed all
        if (!_prims.empty()) _prims.erase(entry.primPath);
}

void HdPatinaDirtiedPrimvars::PrimsRemoved(const HdSceneIndexBase&,
                                           const RemovedPrimEntries& entries) {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const RemovedPrimEntry& entry : entries)
        for (auto it = _prims.begin(); it != _prims.end();)
            it = it->first.HasPrefix(entry.primPath) ? _prims.erase(it) : std::next(it);
}

void HdPatinaDirtiedPrimvars::PrimsDirtied(const HdSceneIndexBase&,
                                           const DirtiedPrimEntries& entries) {
    const HdDataSourceLocator& primvars = HdPrimvarsSchema::GetDefaultLocator();
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const DirtiedPrimEntry& entry : entries) {
        if (!entry.dirtyLocators.Intersects(primvars)) continue;
        Dirtied& dirtied = _prims[entry.primPath];
        for (const HdDataSourceLocator& locator : entry.dirtyLocators)
            if (locator.GetElementCount() > 1 && locator.HasPrefix(primvars))
                dirtied.names.insert(locator.GetElement(1).GetString());
            else if (locator.Intersects(primvars))
                dirtied.all = true;
    }
}

void HdPatinaDirtiedPrimvars::PrimsRenamed(const HdSceneIndexBase& sender,
                                           const RenamedPrimEntries& entries) {
    ConvertPrimsRenamedToRemovedAndAdded(sender, entries, this);
}

} // namespace patina
