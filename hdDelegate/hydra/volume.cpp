// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/volume.h"

#include "hdDelegate/hydra/lightParams.h"
#include "hdDelegate/hydra/values.h"
#include "hdDelegate/scene/lightUnits.h"

#include <pxr/imaging/hd/light.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A volume that is a light gives others more or less of its glow than is seen of it.
void readGlow(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
              Volume& volume) {
    volume.light = vec3(1.0f);
    if (!delegate.GetLightParamValue(id, HdTokens->isLight).GetWithDefault(false)) return;
    Light light;
    readLightParams(delegate, param, id, HdPrimTypeTokens->meshLight, light);
    const vec3 glow = lightBaseRadiance(light);
    const bool usable =
        std::isfinite(glow.x + glow.y + glow.z) && std::min({glow.x, glow.y, glow.z}) >= 0.0f;
    if (usable && light.materialSyncMode == Light().materialSyncMode)
        volume.light = glow;
    else
        param.warn(id, "light:materialSyncMode", messages::volumeLightIgnored());
}

} // namespace

const TfTokenVector& fieldTypes() {
    // UsdVolImaging's name for them; linking that library for a word would tie the plugin to it.
    static const TfTokenVector types = {TfToken("openvdbAsset")};
    return types;
}

void HdPatinaField::Sync(HdSceneDelegate*, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    if (*dirtyBits != Clean) static_cast<HdPatinaRenderParam*>(renderParam)->setChanged(GetId());
    *dirtyBits = Clean;
}

void HdPatinaVolume::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                               HdDirtyBits dirtyBits, bool all, const TfToken&, Volume& volume) {
    if (!all && !(dirtyBits & (HdChangeTracker::DirtyVolumeField | HdChangeTracker::DirtyTopology)))
        return;
    readGlow(delegate, param, GetId(), volume);
    volume.fields.clear();
    for (const HdVolumeFieldDescriptor& field : delegate.GetVolumeFieldDescriptors(GetId())) {
        const std::string input = "field:" + field.fieldName.GetString();
        if (std::find(fieldTypes().begin(), fieldTypes().end(), field.fieldPrimType) ==
            fieldTypes().end()) {
            param.warn(GetId(), input, messages::fieldOfType(field.fieldPrimType.GetString()));
            continue;
        }
        const std::string name = textOf(delegate.Get(field.fieldId, HdFieldTokens->fieldName));
        volume.fields.push_back({field.fieldName.GetString(),
                                 textOf(delegate.Get(field.fieldId, HdFieldTokens->filePath)),
                                 name.empty() ? field.fieldName.GetString() : name, nullptr});
        param.use(field.fieldId, GetId());
    }
    std::sort(volume.fields.begin(), volume.fields.end(),
              [](const VolumeField& a, const VolumeField& b) { return a.name < b.name; });
}

} // namespace patina
