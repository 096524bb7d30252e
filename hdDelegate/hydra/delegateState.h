// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/hostTextures.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/hydra/session.h"
#include "hdDelegate/hydra/settings.h"

#include <pxr/imaging/hd/renderSettings.h>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace patina {

/// A UsdRenderSettings prim as Hydra brings it.
struct HdPatinaSettingsPrim {
    bool active = false;
    VtDictionary settings; ///< namespaced
    std::string renderingColorSpace;
    HdRenderSettings::RenderProducts products;
};

/// State that a delegate and its render passes share. Passes hold it, so that they may outlive the
/// delegate, in whatever order a host tears things down.
class HdPatinaDelegateState {
public:
    HdPatinaRenderParam param;
    /// Buffers hold it too, and may go last.
    const std::shared_ptr<HdPatinaHostTextures> hostTextures =
        std::make_shared<HdPatinaHostTextures>();

    /// The delegate's setting map, and on top of it the active settings prim.
    HdPatinaSettings settings() const;
    void setSettings(const HdPatinaSettings& settings);
    unsigned int settingsVersion() const { return _settingsVersion; }

    void setSettingsPrim(const SdfPath& path, HdPatinaSettingsPrim prim);
    void removeSettingsPrim(const SdfPath& path);
    /// Products of the active settings prim.
    HdRenderSettings::RenderProducts products() const;

    std::shared_ptr<HdPatinaSession> makeSession();
    std::vector<std::shared_ptr<HdPatinaSession>> sessions() const;
    /// A number that no other pass of this delegate has.
    int nextPass() { return ++_passes; }

    void pause(bool paused);
    bool paused() const { return _paused; }
    void stop();
    void restart();
    bool stopped() const { return _stopped; }

private:
    void updateRenderingSpace();

    mutable std::mutex _mutex;
    HdPatinaSettings _settings;
    std::map<SdfPath, HdPatinaSettingsPrim> _prims;
    std::atomic<unsigned int> _settingsVersion{1};
    mutable std::vector<std::weak_ptr<HdPatinaSession>> _sessions;
    std::atomic<bool> _paused{false}, _stopped{false};
    std::atomic<int> _passes{0};
};

} // namespace patina
