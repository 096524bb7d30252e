// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderDelegate.h"

#include "hdDelegate/hydra/aovs.h"
#include "hdDelegate/hydra/basisCurves.h"
#include "hdDelegate/hydra/camera.h"
#include "hdDelegate/hydra/commands.h"
#include "hdDelegate/hydra/coordSys.h"
#include "hdDelegate/hydra/implicit.h"
#include "hdDelegate/hydra/instancer.h"
#include "hdDelegate/hydra/light.h"
#include "hdDelegate/hydra/lightFilter.h"
#include "hdDelegate/hydra/material.h"
#include "hdDelegate/hydra/mesh.h"
#include "hdDelegate/hydra/points.h"
#include "hdDelegate/hydra/renderBuffer.h"
#include "hdDelegate/hydra/renderPass.h"
#include "hdDelegate/hydra/renderSettingsPrim.h"
#include "hdDelegate/hydra/renderStats.h"
#include "hdDelegate/hydra/settingsTable.h"
#include "hdDelegate/hydra/splats.h"
#include "hdDelegate/hydra/volume.h"

#include <pxr/base/tf/diagnostic.h>
#include <pxr/imaging/hd/extComputation.h>
#include <pxr/imaging/hd/sceneIndex.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>

namespace patina {

namespace {

const TfTokenVector& implicitTypes() {
    static const TfTokenVector types = {HdPrimTypeTokens->sphere,  HdPrimTypeTokens->cube,
                                        HdPrimTypeTokens->cone,    HdPrimTypeTokens->cylinder,
                                        HdPrimTypeTokens->capsule, TfToken("plane")};
    return types;
}

const TfTokenVector& lightTypes() {
    static const TfTokenVector types = [] {
        TfTokenVector all;
        for (const LightRow& row : lightRows)
            all.emplace_back(row.hydra);
        return all;
    }();
    return types;
}

bool contains(const TfTokenVector& types, const TfToken& type) {
    return std::find(types.begin(), types.end(), type) != types.end();
}

} // namespace

HdPatinaRenderDelegate::HdPatinaRenderDelegate(const HdRenderSettingsMap& settings,
                                               const std::string& backend)
    : _backend(backend), _state(std::make_shared<HdPatinaDelegateState>()),
      _registry(std::make_shared<HdResourceRegistry>()) {
    _PopulateDefaultSettings(settingDescriptors(_backend));
    for (const auto& item : settings)
        SetRenderSetting(item.first, item.second);
    applySettings();
}

HdPatinaRenderDelegate::~HdPatinaRenderDelegate() {
    for (const auto& session : _state->sessions())
        session->leaveDevice();
    HdPatinaRenderBuffer::leaveDevice(*_state->hostTextures);
    _state->hostTextures->release();
}

const TfTokenVector& HdPatinaRenderDelegate::GetSupportedRprimTypes() const {
    static const TfTokenVector types = [] {
        TfTokenVector all = {HdPrimTypeTokens->mesh, HdPrimTypeTokens->basisCurves,
                             HdPrimTypeTokens->points, HdPrimTypeTokens->volume, splatsType()};
        all.insert(all.end(), implicitTypes().begin(), implicitTypes().end());
        return all;
    }();
    return types;
}

const TfTokenVector& HdPatinaRenderDelegate::GetSupportedSprimTypes() const {
    // They sync in this order.
    static const TfTokenVector types = [] {
        TfTokenVector all = {HdPrimTypeTokens->camera, HdPrimTypeTokens->coordSys,
                             HdPrimTypeTokens->material, HdPrimTypeTokens->extComputation,
                             HdPrimTypeTokens->lightFilter};
        all.insert(all.end(), lightTypes().begin(), lightTypes().end());
        return all;
    }();
    return types;
}

const TfTokenVector& HdPatinaRenderDelegate::GetSupportedBprimTypes() const {
    static const TfTokenVector types = [] {
        TfTokenVector all = {HdPrimTypeTokens->renderBuffer, HdPrimTypeTokens->renderSettings};
        all.insert(all.end(), fieldTypes().begin(), fieldTypes().end());
        return all;
    }();
    return types;
}

void HdPatinaRenderDelegate::applySettings() {
    HdPatinaSettings settings;
    for (const auto& item : _settingsMap) {
        const TfToken key = settingKey(item.first);
        if (key.IsEmpty()) continue;
        const std::string problem = applySetting(key, item.second, settings);
        if (!problem.empty())
            TF_WARN("render setting %s %s", item.first.GetText(), problem.c_str());
    }
    _state->setSettings(settings);
}

void HdPatinaRenderDelegate::SetRenderSetting(const TfToken& name, const VtValue& value) {
    const TfToken key = settingKey(name);
    if (key.IsEmpty()) { // hosts keep things of their own here
        if (name == "stageMetersPerUnit") {
            const VtValue number = VtValue::Cast<double>(value);
            if (!number.IsHolding<double>() && !value.IsEmpty()) {
                TF_WARN("render setting %s has a value of the wrong type; it is left as it was",
                        name.GetText());
                return;
            }
            _state->param.setMetersPerUnit(number.GetWithDefault<double>(0.01));
        }
        HdRenderDelegate::SetRenderSetting(name, value);
        return;
    }
    HdPatinaSettings scratch;
    const std::string problem = applySetting(key, value, scratch);
    if (!problem.empty()) {
        TF_WARN("render setting %s %s", name.GetText(), problem.c_str());
        return;
    }
    const unsigned int before = _settingsVersion;
    HdRenderDelegate::SetRenderSetting(key, settingValue(key, value));
    if (_settingsVersion != before) applySettings();
}

VtValue HdPatinaRenderDelegate::GetRenderSetting(const TfToken& name) const {
    const TfToken key = settingKey(name);
    return HdRenderDelegate::GetRenderSetting(key.IsEmpty() ? name : key);
}

HdRenderSettingDescriptorList HdPatinaRenderDelegate::GetRenderSettingDescriptors() const {
    return settingDescriptors(_backend);
}

VtDictionary HdPatinaRenderDelegate::GetRenderStats() const {
    return renderStats(*_state);
}

bool HdPatinaRenderDelegate::Pause() {
    _state->pause(true);
    return true;
}

bool HdPatinaRenderDelegate::Resume() {
    _state->pause(false);
    return true;
}

bool HdPatinaRenderDelegate::Stop(bool) {
    _state->stop();
    return true;
}

bool HdPatinaRenderDelegate::Restart() {
    _state->restart();
    return true;
}

HdRenderPassSharedPtr
HdPatinaRenderDelegate::CreateRenderPass(HdRenderIndex* index,
                                         const HdRprimCollection& collection) {
    return std::make_shared<HdPatinaRenderPass>(index, collection, _state);
}

HdInstancer* HdPatinaRenderDelegate::CreateInstancer(HdSceneDelegate* delegate, const SdfPath& id) {
    return new HdPatinaInstancer(delegate, id);
}

void HdPatinaRenderDelegate::DestroyInstancer(HdInstancer* instancer) {
    delete instancer;
}

HdRprim* HdPatinaRenderDelegate::CreateRprim(const TfToken& type, const SdfPath& id) {
    if (type == HdPrimTypeTokens->mesh) return new HdPatinaMesh(id);
    if (type == HdPrimTypeTokens->basisCurves) return new HdPatinaBasisCurves(id);
    if (type == HdPrimTypeTokens->points) return new HdPatinaPoints(id);
    if (type == HdPrimTypeTokens->volume) return new HdPatinaVolume(id);
    if (type == splatsType()) return new HdPatinaSplats(id);
    if (contains(implicitTypes(), type)) return new HdPatinaImplicit(type, id);
    TF_WARN("%s: prims of type %s cannot be drawn", id.GetText(), type.GetText());
    return nullptr;
}

void HdPatinaRenderDelegate::DestroyRprim(HdRprim* prim) {
    delete prim;
}

HdSprim* HdPatinaRenderDelegate::CreateSprim(const TfToken& type, const SdfPath& id) {
    if (type == HdPrimTypeTokens->camera) return new HdPatinaCamera(id);
    if (type == HdPrimTypeTokens->material) return new HdPatinaMaterial(id);
    if (type == HdPrimTypeTokens->coordSys) return new HdPatinaCoordSys(id);
    if (type == HdPrimTypeTokens->extComputation) return new HdExtComputation(id);
    if (type == HdPrimTypeTokens->lightFilter) return new HdPatinaLightFilter(id);
    if (contains(lightTypes(), type)) return new HdPatinaLight(type, id);
    TF_WARN("%s: prims of type %s are not known", id.GetText(), type.GetText());
    return nullptr;
}

HdSprim* HdPatinaRenderDelegate::CreateFallbackSprim(const TfToken& type) {
    return CreateSprim(type, SdfPath::EmptyPath());
}

void HdPatinaRenderDelegate::DestroySprim(HdSprim* prim) {
    delete prim;
}

HdBprim* HdPatinaRenderDelegate::CreateBprim(const TfToken& type, const SdfPath& id) {
    if (type == HdPrimTypeTokens->renderBuffer)
        return new HdPatinaRenderBuffer(id, _state->hostTextures);
    if (type == HdPrimTypeTokens->renderSettings) return new HdPatinaRenderSettings(id, _state);
    if (contains(fieldTypes(), type)) return new HdPatinaField(id);
    TF_WARN("%s: prims of type %s are not known", id.GetText(), type.GetText());
    return nullptr;
}

HdBprim* HdPatinaRenderDelegate::CreateFallbackBprim(const TfToken& type) {
    return CreateBprim(type, SdfPath::EmptyPath());
}

void HdPatinaRenderDelegate::DestroyBprim(HdBprim* prim) {
    delete prim;
}

void HdPatinaRenderDelegate::SetTerminalSceneIndex(const HdSceneIndexBaseRefPtr& sceneIndex) {
    if (sceneIndex)
        sceneIndex->AddObserver(HdSceneIndexObserverPtr(&_state->param.dirtiedPrimvars()));
}

void HdPatinaRenderDelegate::CommitResources(HdChangeTracker*) {
    _state->param.commit();
    _state->param.reportWarnings();
}

TfToken HdPatinaRenderDelegate::materialBindingPurpose() {
    return HdTokens->full;
}

TfTokenVector HdPatinaRenderDelegate::materialRenderContexts() {
    // Some releases stop at the first context that yields anything, and every lookup falls back to
    // the universal one: mtlx has to come first.
    return {TfToken("mtlx"), TfToken()};
}

TfTokenVector HdPatinaRenderDelegate::renderSettingsNamespaces() {
    return {TfToken("patina")};
}

TfTokenVector HdPatinaRenderDelegate::shaderSourceTypes() {
    return {TfToken("patina"), TfToken("mtlx")};
}

#if PATINA_HAS_PARALLEL_SPRIM_SYNC
bool HdPatinaRenderDelegate::IsParallelSyncEnabled(const TfToken& primType) const {
    return primType == HdPrimTypeTokens->material;
}
#endif

HdAovDescriptor HdPatinaRenderDelegate::GetDefaultAovDescriptor(const TfToken& name) const {
    return aovDescriptor(name);
}

HdCommandDescriptors HdPatinaRenderDelegate::GetCommandDescriptors() const {
    return commandDescriptors();
}

bool HdPatinaRenderDelegate::InvokeCommand(const TfToken& command, const HdCommandArgs& args) {
    return invokeCommand(*_state, command, args);
}

} // namespace patina
