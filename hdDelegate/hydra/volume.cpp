// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/volume.h"

#include "hdDelegate/hydra/values.h"

#include <algorithm>

namespace patina {

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
