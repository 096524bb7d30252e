// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/readAgain.h"

#include "hdDelegate/hydra/camera.h"
#include "hdDelegate/hydra/instancer.h"
#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/light.h"
#include "hdDelegate/hydra/linkedPrim.h"
#include "hdDelegate/scene/light.h"

#include <pxr/base/work/loops.h>
#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/tokens.h>

namespace patina {

namespace {

/// @param read is called with each instancer
template <class F>
void forInstancers(HdRenderIndex& index, HdPatinaRenderParam& param, const F& read) {
    for (const SdfPath& path : param.instances().instancers())
        if (HdInstancer* instancer = index.GetInstancer(path))
            read(*static_cast<HdPatinaInstancer*>(instancer));
}

/// @param read is called where there is such a prim
template <class F> void forRprim(HdRenderIndex& index, const SdfPath& path, const F& read) {
    auto* prim = dynamic_cast<HdPatinaLinkedPrim*>(const_cast<HdRprim*>(index.GetRprim(path)));
    HdSceneDelegate* delegate = index.GetSceneDelegateForRprim(path);
    if (prim && delegate) read(*prim, *delegate);
}

/// Neither UsdImagingDelegate nor Hydra's light linking tells all prims whose links have changed.
void readLinks(HdRenderIndex& index, HdPatinaRenderParam& param) {
    forInstancers(index, param,
                  [&](HdPatinaInstancer& instancer) { instancer.updateCategories(param); });
    for (const SdfPath& path : index.GetRprimIds())
        forRprim(index, path, [&](HdPatinaLinkedPrim& prim, HdSceneDelegate& delegate) {
            prim.updateCategories(delegate, param);
        });
}

/// The change tracker takes no mark of prims that come from scene indices, and an instancer that
/// only lights ask for syncs with none of them.
void readSamples(HdRenderIndex& index, HdPatinaRenderParam& param) {
    forInstancers(index, param,
                  [&](HdPatinaInstancer& instancer) { instancer.updateTransforms(param); });
    for (const LightRow& row : lightRows) {
        const TfToken type(row.hydra);
        for (const SdfPath& path : index.GetSprimSubtree(type, SdfPath::AbsoluteRootPath()))
            if (HdSprim* light = index.GetSprim(type, path))
                static_cast<HdPatinaLight*>(light)->updateTransform(param);
    }
    const TfToken& cameras = HdPrimTypeTokens->camera;
    for (const SdfPath& path : index.GetSprimSubtree(cameras, SdfPath::AbsoluteRootPath()))
        if (HdSprim* camera = index.GetSprim(cameras, path))
            static_cast<HdPatinaCamera*>(camera)->updateTransform(param);
    const SdfPathVector& rprims = index.GetRprimIds();
    WorkParallelForN(rprims.size(), [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            forRprim(index, rprims[i], [&](HdPatinaLinkedPrim& prim, HdSceneDelegate& delegate) {
                prim.updateSamples(delegate, param);
            });
    });
}

/// All colours that hosts do not keep.
void readColors(HdRenderIndex& index, HdPatinaRenderParam& param) {
    forInstancers(index, param,
                  [&](HdPatinaInstancer& instancer) { instancer.updateColors(param); });
    for (const LightRow& row : lightRows) {
        const TfToken type(row.hydra);
        for (const SdfPath& path : index.GetSprimSubtree(type, SdfPath::AbsoluteRootPath()))
            if (HdSprim* light = index.GetSprim(type, path))
                static_cast<HdPatinaLight*>(light)->updateParams(param);
    }
    for (const SdfPath& path : index.GetRprimIds())
        forRprim(index, path, [&](HdPatinaLinkedPrim& prim, HdSceneDelegate& delegate) {
            prim.updateBits(delegate, param, HdChangeTracker::DirtyPrimvar);
        });
}

void readOthers(HdRenderIndex& index, HdPatinaRenderParam& param, const SdfPath& reader) {
    // Of a coordinate system, which is read with categories, or of a field.
    forRprim(index, reader, [&](HdPatinaLinkedPrim& prim, HdSceneDelegate& delegate) {
        prim.updateBits(delegate, param,
                        HdChangeTracker::DirtyCategories | HdChangeTracker::DirtyVolumeField);
    });
    for (const LightRow& row : lightRows)
        if (HdSprim* light = index.GetSprim(TfToken(row.hydra), reader))
            static_cast<HdPatinaLight*>(light)->updateFilters(param);
}

} // namespace

void readAgain(HdRenderIndex& index, HdPatinaRenderParam& param) {
    if (param.takeLinksChanged()) readLinks(index, param);
    if (param.takeRenderingSpaceChanged()) readColors(index, param);
    if (param.takeShutterWidened()) readSamples(index, param);
    for (const SdfPath& reader : param.takeReadersOfChanged())
        readOthers(index, param, reader);
}

} // namespace patina
