// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "plugin/hydra/filterSceneIndex.h"

#if PATINA_HAS_RENDER_PASSES

#include <pxr/imaging/hd/collectionExpressionEvaluator.h>
#include <pxr/usd/sdf/pathExpression.h>

#include <array>
#include <optional>

PXR_NAMESPACE_OPEN_SCOPE

/// Draws what the collections of the active UsdRenderPass say: prims that `renderVisibility` leaves
/// out and those that `prune` takes away are hidden, what `cameraVisibility` leaves out and what is
/// a `matte` gets the marks of it. Of native instances whole ones are hidden; what is in them is
/// where all of them say so.
class HdPatinaRenderPassSceneIndex final
    : public HdPatinaFilterSceneIndex<HdPatinaRenderPassSceneIndex> {
public:
    explicit HdPatinaRenderPassSceneIndex(const HdSceneIndexBaseRefPtr& input);
    HdSceneIndexPrim GetPrim(const SdfPath& path) const override;

protected:
    void _PrimsAdded(const HdSceneIndexBase& sender, const Added& entries) override;
    void _PrimsRemoved(const HdSceneIndexBase& sender, const Removed& entries) override;
    void _PrimsDirtied(const HdSceneIndexBase& sender, const Dirtied& entries) override;

private:
    enum Collection { RenderVisibility, Prune, CameraVisibility, Matte, CollectionCount };
    struct Members {
        SdfPathExpression expression;
        std::optional<HdCollectionExpressionEvaluator> evaluator; ///< none: it is not authored
    };
    using Collections = std::array<Members, CollectionCount>;

    bool has(Collection collection, const SdfPath& path) const;
    bool isDrawn(const SdfPath& path) const {
        return has(RenderVisibility, path) && !has(Prune, path);
    }
    /// Reads the active pass.
    /// @returns whether another one is active, or it has other collections
    bool update();
    /// Reads the active pass where one of the entries may be it, and tells all prims of a new one.
    template <class Entries> void updateFrom(const Entries& entries);

    SdfPath _path; ///< of the active pass; empty: there is none
    Collections _collections;
};

PXR_NAMESPACE_CLOSE_SCOPE

#endif
