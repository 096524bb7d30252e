// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/delegateState.h"

#include "hdDelegate/hydra/settingsTable.h"

namespace patina {

HdPatinaSettings HdPatinaDelegateState::settings() const {
    std::lock_guard<std::mutex> lock(_mutex);
    HdPatinaSettings settings = _settings;
    for (const auto& prim : _prims) {
        if (!prim.second.active) continue;
        if (!prim.second.renderingColorSpace.empty())
            settings.renderingColorSpace = prim.second.renderingColorSpace;
        for (const auto& item : prim.second.settings) {
            const TfToken key = settingKey(TfToken(item.first));
            if (!key.IsEmpty()) applySetting(key, item.second, settings);
        }
    }
    return settings;
}

/// Settings prims sync before all that has colours.
void HdPatinaDelegateState::updateRenderingSpace() {
    const std::string name = settings().renderingColorSpace;
    const RenderingSpace* space = RenderingSpace::find(name);
    if (!space) {
        SdfPath path; // empty: the host's own setting
        {
            std::lock_guard<std::mutex> lock(_mutex);
            for (const auto& prim : _prims)
                if (prim.second.active && prim.second.renderingColorSpace == name)
                    path = prim.first;
        }
        param.warn(path, "renderingColorSpace", messages::renderingSpaceUnknown(name));
    }
    param.setRenderingSpace(space ? *space : RenderingSpace::rec709());
}

void HdPatinaDelegateState::setSettings(const HdPatinaSettings& settings) {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _settings = settings;
        ++_settingsVersion;
    }
    updateRenderingSpace();
}

void HdPatinaDelegateState::setSettingsPrim(const SdfPath& path, HdPatinaSettingsPrim prim) {
    HdPatinaSettings scratch;
    for (const auto& item : prim.settings) {
        const TfToken key = settingKey(TfToken(item.first));
        const std::string problem = key.IsEmpty() ? "is no render setting of Patina"
                                                  : applySetting(key, item.second, scratch);
        if (!problem.empty()) param.warn(path, item.first, messages::settingProblem(problem));
    }
    {
        std::lock_guard<std::mutex> lock(_mutex);
        _prims[path] = std::move(prim);
        ++_settingsVersion;
    }
    updateRenderingSpace();
}

void HdPatinaDelegateState::removeSettingsPrim(const SdfPath& path) {
    {
        std::lock_guard<std::mutex> lock(_mutex);
        if (!_prims.erase(path)) return;
        ++_settingsVersion;
    }
    updateRenderingSpace();
}

HdRenderSettings::RenderProducts HdPatinaDelegateState::products() const {
    std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& prim : _prims)
        if (prim.second.active) return prim.second.products;
    return {};
}

std::shared_ptr<HdPatinaSession> HdPatinaDelegateState::makeSession() {
    auto session = std::make_shared<HdPatinaSession>(param.scene());
    std::lock_guard<std::mutex> lock(_mutex);
    _sessions.push_back(session);
    return session;
}

std::vector<std::shared_ptr<HdPatinaSession>> HdPatinaDelegateState::sessions() const {
    std::lock_guard<std::mutex> lock(_mutex);
    std::vector<std::shared_ptr<HdPatinaSession>> alive;
    std::vector<std::weak_ptr<HdPatinaSession>> kept;
    for (const auto& weak : _sessions)
        if (auto session = weak.lock()) {
            alive.push_back(session);
            kept.push_back(weak);
        }
    _sessions.swap(kept);
    return alive;
}

void HdPatinaDelegateState::pause(bool paused) {
    _paused = paused;
    for (const auto& session : sessions())
        paused ? session->pause() : session->resume();
}

void HdPatinaDelegateState::stop() {
    _stopped = true;
    for (const auto& session : sessions())
        session->stop();
}

void HdPatinaDelegateState::restart() {
    _stopped = _paused = false;
    ++_settingsVersion; // every pass starts over when it executes next
}

} // namespace patina
