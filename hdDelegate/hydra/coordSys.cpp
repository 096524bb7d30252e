// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/coordSys.h"

#include "hdDelegate/hydra/primvars.h"
#include "materialNetwork/material.h"

#include <pxr/base/gf/matrix4d.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>

namespace patina {

void HdPatinaCoordSys::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam,
                            HdDirtyBits* dirtyBits) {
    static_cast<HdPatinaRenderParam*>(renderParam)->setChanged(GetId());
    HdCoordSys::Sync(delegate, renderParam, dirtyBits);
}

void HdPatinaCoordSys::Finalize(HdRenderParam* renderParam) {
    static_cast<HdPatinaRenderParam*>(renderParam)->setChanged(GetId());
}

void readCoordSystems(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                      Geometry& prim) {
    auto& list = prim.primvars;
    list.erase(std::remove_if(list.begin(), list.end(),
                              [](const Primvar& p) { return !spaceOfPrimvar(p.name).empty(); }),
               list.end());
    const HdIdVectorSharedPtr bound = delegate.GetCoordSysBindings(id);
    if (!bound) return;
    for (const SdfPath& path : *bound) {
        param.use(path, id);
        const auto* space = static_cast<const HdCoordSys*>(
            delegate.GetRenderIndex().GetSprim(HdPrimTypeTokens->coordSys, path));
        if (!space) continue;
        double determinant = 0.0;
        const GfMatrix4d matrix = delegate.GetTransform(path).GetInverse(&determinant);
        const std::string name = space->GetName().GetString();
        if (determinant == 0.0) {
            param.warn(id, "coordSys:" + name, messages::coordSysUnusable(path.GetString()));
            continue;
        }
        for (int row = 0; row < 4; ++row) {
            Primvar primvar;
            primvar.name = spacePrimvar(name, row);
            primvar.interpolation = Interpolation::Constant;
            primvar.components = 4;
            for (int column = 0; column < 3; ++column)
                primvar.values.push_back(float(matrix[row][column]));
            primvar.values.push_back(0.0f); // from the world
            replacePrimvar(prim, std::move(primvar));
        }
    }
}

} // namespace patina
