// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/delegateState.h"

#include <pxr/imaging/hd/renderSettings.h>

namespace patina {

/// UsdRenderSettings: its settings of the namespace `patina:` lie over those of the host while it
/// is active, and its products are written by hosts that are not interactive.
class HdPatinaRenderSettings final : public HdRenderSettings {
public:
    HdPatinaRenderSettings(const SdfPath& id, std::shared_ptr<HdPatinaDelegateState> state)
        : HdRenderSettings(id), _state(std::move(state)) {}

    void Finalize(HdRenderParam*) override { _state->removeSettingsPrim(GetId()); }

protected:
    void _Sync(HdSceneDelegate*, HdRenderParam*, const HdDirtyBits*) override {
        _state->setSettingsPrim(GetId(),
                                {IsActive(), GetNamespacedSettings(),
                                 GetRenderingColorSpace().GetString(), GetRenderProducts()});
    }

private:
    std::shared_ptr<HdPatinaDelegateState> _state;
};

} // namespace patina
