// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderPass.h"

#include "hdDelegate/hydra/linkedPrim.h"

#include "hdDelegate/backends/backends.h"
#include "hdDelegate/film/aovTable.h"
#include "hdDelegate/hydra/clearValue.h"
#include "hdDelegate/hydra/readAgain.h"

#include <pxr/base/tf/diagnostic.h>
#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/renderPassState.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>

namespace patina {

bool HdPatinaRenderPass::Target::operator==(const Target& other) const {
    return aovName == other.aovName && buffer == other.buffer && allocation == other.allocation &&
           clearValue == other.clearValue;
}

HdPatinaRenderPass::HdPatinaRenderPass(HdRenderIndex* index, const HdRprimCollection& collection,
                                       std::shared_ptr<HdPatinaDelegateState> state)
    : HdRenderPass(index, collection), _state(std::move(state)), _session(_state->makeSession()),
      _products(*_state), _cameraPath("patinaView:" + std::to_string(_state->nextPass())) {}

HdPatinaRenderPass::~HdPatinaRenderPass() {
    _session->stop();
    if (_hasOwnCamera) {
        _state->param.removeCamera(_cameraPath);
        _state->param.commit();
    }
}

bool HdPatinaRenderPass::IsConverged() const {
    return _converged || _state->stopped();
}

std::vector<HdPatinaRenderPass::Target>
HdPatinaRenderPass::targetsOf(const HdRenderPassAovBindingVector& bindings) {
    std::vector<Target> targets;
    for (const HdRenderPassAovBinding& binding : bindings) {
        HdPatinaRenderBuffer* own = HdPatinaRenderBuffer::known(binding.renderBuffer);
        if (!own && !binding.renderBufferId.IsEmpty())
            own =
                HdPatinaRenderBuffer::known(static_cast<HdRenderBuffer*>(GetRenderIndex()->GetBprim(
                    HdPrimTypeTokens->renderBuffer, binding.renderBufferId)));
        if (!own) continue;
        // What is wrong with a name is said once, not with each repaint.
        auto known = _shownAovs.find(binding.aovName);
        if (known == _shownAovs.end())
            known = _shownAovs.emplace(binding.aovName, shownAovOf(binding.aovName)).first;
        HdPatinaShownAov shown = known->second;
        if (shown.exact() && own->GetFormat() != HdFormatFloat32Vec4) {
            if (_inexact.insert(binding.aovName).second)
                TF_WARN("AOV %s needs a buffer of four 32-bit floats; this one stays empty",
                        binding.aovName.GetText());
            shown = {};
        }
        targets.push_back({binding.aovName, shown, own, own->allocation(), binding.clearValue});
    }
    return targets;
}

HdPatinaSettings HdPatinaRenderPass::settingsFor(const HdPatinaView& view,
                                                 const TfTokenVector& renderTags) const {
    HdPatinaSettings settings = _state->settings();
    settings.width = view.width;
    settings.height = view.height;
    std::copy(view.dataWindow, view.dataWindow + 4, settings.dataWindow.begin());
    settings.pixelAspectRatio = view.pixelAspectRatio;
    settings.aspectRatioConformPolicy = view.policy;
    for (const TfToken& tag : renderTags)
        settings.renderTags.push_back(tag.GetString());
    for (const SdfPath& path : GetRprimCollection().GetRootPaths())
        if (!path.IsAbsoluteRootPath()) settings.rootPaths.push_back(path.GetString());
    for (const SdfPath& path : GetRprimCollection().GetExcludePaths())
        settings.excludePaths.push_back(path.GetString());
    for (const Target& target : _targets) {
        const HdPatinaShownAov& shown = target.shown;
        if (!shown.film.empty()) settings.aovs.push_back(shown.film);
        settings.cryptomatteLevels = std::max(settings.cryptomatteLevels, 2 * (shown.layer + 1));
    }
    // Several layers are of one AOV.
    std::set<std::string> known;
    settings.aovs.erase(std::remove_if(settings.aovs.begin(), settings.aovs.end(),
                                       [&](const auto& a) { return !known.insert(a).second; }),
                        settings.aovs.end());
    return settings;
}

void HdPatinaRenderPass::_Execute(const HdRenderPassStateSharedPtr& passState,
                                  const TfTokenVector& renderTags) {
    const std::vector<Target> current = targetsOf(passState->GetAovBindings());
    std::vector<std::string> aovs = _products.aovs();
    for (const Target& target : current)
        aovs.push_back(target.shown.film);
    if (tellMotion(aovs)) _state->param.tellMotion();
    readAgain(*GetRenderIndex(), _state->param);
    if (_products.wanted()) {
        // A host that stopped, or pauses, wants no product more.
        if (!_state->stopped() && !_state->paused()) _converged = _products.update();
        for (const Target& target : current)
            target.buffer->setConverged(_converged);
        _state->param.reportWarnings();
        return;
    }

    const int width = current.empty() ? 0 : int(current.front().buffer->GetWidth());
    const int height = current.empty() ? 0 : int(current.front().buffer->GetHeight());
    HdPatinaRenderParam& param = _state->param;
    readRenderTags();
    param.commit(); // hosts may execute without CommitResources
    const HdPatinaView view =
        viewOf(*passState, param.scene()->snapshot()->cameras, width, height, _cameraPath);
    if (!view.finite) param.warn(SdfPath(), "framing or camera matrices", messages::viewNotFinite);
    const bool moved = !(view == _view);
    if (view.ownCamera && (moved || !_hasOwnCamera)) {
        param.set(std::shared_ptr<const Camera>(std::make_shared<Camera>(view.camera)));
        param.commit();
        _hasOwnCamera = true;
    }

    const uint64_t sceneVersion = param.scene()->snapshot()->version;
    const unsigned int settingsVersion = _state->settingsVersion();
    const bool changed = moved || sceneVersion != _sceneVersion ||
                         settingsVersion != _settingsVersion || renderTags != _renderTags ||
                         !(GetRprimCollection() == _shownCollection) || !(current == _targets);
    if (changed && !_state->paused() && !_state->stopped()) {
        for (const Target& target : current) {
            bool known = false;
            for (const Target& before : _targets)
                known |= before.buffer == target.buffer && before.allocation == target.allocation;
            // The last frame stays until there is a new one: no flicker.
            if (!known) target.buffer->clear(target.clearValue);
            target.buffer->setConverged(false);
        }
        _targets = current;
        _view = view;
        _renderTags = renderTags;
        _shownCollection = GetRprimCollection();
        _sceneVersion = sceneVersion;
        _settingsVersion = settingsVersion;
        _pending.reset();
        _converged = false;
        const HdPatinaSettings settings = settingsFor(view, renderTags);
        if (settings.width < 1 || settings.height < 1) {
            _session->stop();
            for (const Target& target : _targets)
                target.buffer->clear(target.clearValue);
            finish();
        } else {
            bool onDevice = false;
            std::shared_ptr<HostDevice> device;
            if (rasterizes(backendOf(settings)))
                device = _state->hostTextures->device(settings.interactive, onDevice);
            onDevice = onDevice && settings.interactive;
            std::vector<HdPatinaImageForm> forms;
            for (const Target& target : _targets)
                forms.push_back({target.shown.film, target.shown.layer, target.buffer->GetFormat(),
                                 target.buffer->GetWidth(), target.buffer->GetHeight(),
                                 clearValueOf(target.clearValue),
                                 onDevice && target.buffer->staysOnDevice()});
            _session->start(view.cameraPath, settings, forms, device);
        }
    }
    if (auto frame = _session->take()) _pending = frame;
    if (!(current == _targets)) { // stopped or paused, and the buffers may be gone
        _pending.reset();
        _targets.clear();
    }
    if (_pending) show(*_pending);
    param.reportWarnings();
}

void HdPatinaRenderPass::readRenderTags() {
    HdRenderIndex& index = *GetRenderIndex();
    const unsigned int version = index.GetChangeTracker().GetRenderTagVersion();
    if (version == _renderTagVersion) return;
    _renderTagVersion = version;
    for (const SdfPath& path : index.GetRprimIds()) {
        auto* prim = dynamic_cast<HdPatinaLinkedPrim*>(const_cast<HdRprim*>(index.GetRprim(path)));
        HdSceneDelegate* delegate = index.GetSceneDelegateForRprim(path);
        if (prim && delegate) prim->updateRenderTag(*delegate, _state->param);
    }
}

void HdPatinaRenderPass::show(HdPatinaFrame& frame) {
    if (!frame.error.empty()) TF_RUNTIME_ERROR("Patina cannot render: %s", frame.error.c_str());
    bool written = true, onDevice = false;
    for (size_t i = 0; i < std::min(_targets.size(), frame.images.size()); ++i) {
        HdPatinaPixels& image = frame.images[i];
        if (image.empty() || _targets[i].buffer->allocation() != _targets[i].allocation) continue;
        onDevice |= image.device != nullptr;
        if (!_targets[i].buffer->take(image)) {
            written = false;
            continue;
        }
        _session->giveBack(std::move(image));
        image = {};
    }
    if (!written) return; // mapped: the next Execute tries again
    _session->countShown(onDevice);
    if (frame.last) finish();
    _pending.reset();
}

void HdPatinaRenderPass::finish() {
    _converged = true;
    for (const Target& target : _targets)
        if (target.buffer->allocation() == target.allocation) target.buffer->setConverged(true);
}

} // namespace patina
