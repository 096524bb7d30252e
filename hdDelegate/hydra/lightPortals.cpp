// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/lightPortals.h"

#include "hdDelegate/hydra/values.h"

#include <pxr/imaging/hd/lightSchema.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/imaging/hd/xformSchema.h>

#include <cmath>

namespace patina {

namespace {

constexpr const char* relationship = "portals";

/// UsdLux's inputs are width and height, 1 where nothing is authored.
float sizeOf(const HdContainerDataSourceHandle& light, const char* name) {
    double given = 1.0;
    if (const auto source = HdSampledDataSource::Cast(light->Get(TfToken(name))))
        if (!numberOf(source->GetValue(0.0f), given)) return 0.0f;
    return float(given);
}

} // namespace

std::vector<LightPortal> readLightPortals(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                          const SdfPath& dome) {
    std::vector<LightPortal> portals;
    const VtValue named = delegate.GetLightParamValue(dome, HdTokens->portals);
    const HdSceneIndexBaseRefPtr scene = delegate.GetRenderIndex().GetTerminalSceneIndex();
    if (!named.IsHolding<SdfPathVector>() || !scene) return portals;
    for (const SdfPath& path : named.UncheckedGet<SdfPathVector>()) {
        const HdContainerDataSourceHandle prim = scene->GetPrim(path).dataSource;
        const HdContainerDataSourceHandle light =
            prim ? HdContainerDataSource::Cast(prim->Get(HdLightSchema::GetSchemaToken()))
                 : nullptr;
        if (!light) {
            param.warn(dome, relationship, messages::noPortalLight(path.GetString()));
            continue;
        }
        LightPortal portal;
        portal.path = path.GetString();
        portal.width = sizeOf(light, "width");
        portal.height = sizeOf(light, "height");
        if (const HdMatrixDataSourceHandle matrix = HdXformSchema::GetFromParent(prim).GetMatrix())
            portal.transform = MotionTransform(toMat4(matrix->GetTypedValue(0.0f)));
        portals.push_back(std::move(portal));
    }
    return portals;
}

} // namespace patina
