// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/sceneIndexObserver.h>

#include <mutex>
#include <set>
#include <string>
#include <unordered_map>

namespace patina {

PXR_NAMESPACE_USING_DIRECTIVE

/// Which primvars of a prim changed. Hydra's dirty bits do not tell one from another; scene indices
/// do, and so a sync fetches no more than an edit touched.
class HdPatinaDirtiedPrimvars final : public HdSceneIndexObserver {
public:
    /// @returns whether all that changed are known by name; names of others then need no fetch. It
    /// forgets them. Any thread.
    bool take(const SdfPath& prim, std::set<std::string>& names);

    void PrimsAdded(const HdSceneIndexBase&, const AddedPrimEntries& entries) override;
    void PrimsRemoved(const HdSceneIndexBase&, const RemovedPrimEntries& entries) override;
    void PrimsDirtied(const HdSceneIndexBase&, const DirtiedPrimEntries& entries) override;
    void PrimsRenamed(const HdSceneIndexBase& sender, const RenamedPrimEntries& entries) override;

private:
    /// Of a prim: names, and whether something changed that they do not tell.
    struct Dirtied {
        std::set<std::string> names;
        bool all = false;
    };
    std::mutex _mutex;
    std::unordered_map<SdfPath, Dirtied, SdfPath::Hash> _prims;
};

} // namespace patina
