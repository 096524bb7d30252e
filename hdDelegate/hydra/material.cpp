// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/material.h"

#include "hdDelegate/hydra/networkConversion.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

void HdPatinaMaterial::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
                            HdDirtyBits* dirtyBits) {
    auto& param = *static_cast<HdPatinaRenderParam*>(renderParam);
    if (*dirtyBits & (DirtyResource | DirtyParams)) {
        auto material = std::make_shared<MaterialPrim>();
        material->path = GetId().GetString();
        material->network = networkOf(delegate->GetMaterialResource(GetId()), GetId(), param);
        param.set(std::shared_ptr<const MaterialPrim>(material));
    }
    *dirtyBits = Clean;
}

void HdPatinaMaterial::Finalize(HdRenderParam* renderParam) {
    static_cast<HdPatinaRenderParam*>(renderParam)->removeMaterial(GetId().GetString());
}

} // namespace patina
