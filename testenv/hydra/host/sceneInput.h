// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/base/tf/token.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/usd/usd/stage.h>

#include <memory>
#include <string>
#include <vector>

PXR_NAMESPACE_USING_DIRECTIVE

namespace patina {

/// The prim that a pixel of an id buffer shows.
struct HostHit {
    SdfPath path;      ///< prim of the stage, instance proxies included
    SdfPath instancer; ///< outermost instancer, empty when there is none
    int index = -1;    ///< instance of the outermost instancer
};

/// One of the two ways from a stage into a render index.
class SceneInput {
public:
    virtual ~SceneInput() = default;

    /// Brings edits of the stage, time and level of refinement to the index.
    virtual void update(UsdTimeCode time, int refineLevel) = 0;
    /// The camera whose shutter says when motion is sampled.
    virtual void setCamera(const SdfPath& path) = 0;
    virtual HostHit decode(int primId, int instanceId) = 0;
    /// Another index on top of the same scene indices, as they are; null when there are none.
    virtual std::unique_ptr<SceneInput> makeShared(HdRenderIndex*) const { return nullptr; }
};

/// UsdImagingDelegate: the default until OpenUSD 25.
std::unique_ptr<SceneInput> makeDelegateInput(HdRenderIndex* index, const UsdStageRefPtr& stage);
/// UsdImaging's chain of scene indices, with a level of refinement and scene globals on top.
std::unique_ptr<SceneInput> makeSceneIndexInput(HdRenderIndex* index, const UsdStageRefPtr& stage);

} // namespace patina
