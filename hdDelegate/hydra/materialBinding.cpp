// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/materialBinding.h"

#include <pxr/imaging/hd/materialBindingsSchema.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/tokens.h>

namespace patina {

SdfPath materialOf(HdSceneDelegate& delegate, const SdfPath& prim, const SdfPath& fallback) {
    const HdSceneIndexBaseRefPtr scene = delegate.GetRenderIndex().GetTerminalSceneIndex();
    if (!scene) return fallback;
    const HdSceneIndexPrim found = scene->GetPrim(prim);
    HdMaterialBindingsSchema bindings = HdMaterialBindingsSchema::GetFromParent(found.dataSource);
    if (!bindings) return fallback;
    HdMaterialBindingSchema binding = bindings.GetMaterialBinding(HdTokens->full);
    const HdPathDataSourceHandle path = binding ? binding.GetPath() : nullptr;
    return path ? path->GetTypedValue(0.0f) : fallback;
}

} // namespace patina
