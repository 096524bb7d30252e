// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/delegateState.h"

#include <pxr/imaging/hd/renderDelegate.h>
#include <pxr/imaging/hd/resourceRegistry.h>

namespace patina {

/// Patina as Hydra sees it.
///
/// Supported: mesh, basisCurves, points, and the implicit shapes as they are; instancers, nested;
/// cameras, all UsdLux lights with their filters and portals, materials, coordinate systems,
/// computations; render buffers; UsdRenderSettings prims. Sync only collects changes (see
/// HdPatinaRenderParam).
class HdPatinaRenderDelegate final : public HdRenderDelegate {
public:
    /// @param backend the default of the setting `backend`
    explicit HdPatinaRenderDelegate(const HdRenderSettingsMap& settings = {},
                                    const std::string& backend = "auto");
    ~HdPatinaRenderDelegate() override;

    const TfTokenVector& GetSupportedRprimTypes() const override;
    const TfTokenVector& GetSupportedSprimTypes() const override;
    const TfTokenVector& GetSupportedBprimTypes() const override;

    void SetDrivers(const HdDriverVector& drivers) override {
        _state->hostTextures->setDrivers(drivers);
    }
    HdRenderParam* GetRenderParam() const override { return &_state->param; }
    HdResourceRegistrySharedPtr GetResourceRegistry() const override { return _registry; }

    void SetRenderSetting(const TfToken& key, const VtValue& value) override;
    VtValue GetRenderSetting(const TfToken& key) const override;
    HdRenderSettingDescriptorList GetRenderSettingDescriptors() const override;
    VtDictionary GetRenderStats() const override;

    bool IsPauseSupported() const override { return true; }
    bool IsPaused() const override { return _state->paused(); }
    bool Pause() override;
    bool Resume() override;
    bool IsStopSupported() const override { return true; }
    bool IsStopped() const override { return _state->stopped(); }
    bool Stop(bool blocking) override;
    bool Restart() override;

    HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex* index,
                                           const HdRprimCollection& collection) override;
    HdInstancer* CreateInstancer(HdSceneDelegate* delegate, const SdfPath& id) override;
    void DestroyInstancer(HdInstancer* instancer) override;
    HdRprim* CreateRprim(const TfToken& type, const SdfPath& id) override;
    void DestroyRprim(HdRprim* prim) override;
    HdSprim* CreateSprim(const TfToken& type, const SdfPath& id) override;
    HdSprim* CreateFallbackSprim(const TfToken& type) override;
    void DestroySprim(HdSprim* prim) override;
    HdBprim* CreateBprim(const TfToken& type, const SdfPath& id) override;
    HdBprim* CreateFallbackBprim(const TfToken& type) override;
    void DestroyBprim(HdBprim* prim) override;
    void CommitResources(HdChangeTracker* tracker) override;
    void SetTerminalSceneIndex(const HdSceneIndexBaseRefPtr& sceneIndex) override;

    /// What plugins of newer releases tell before there is a delegate.
    static TfToken materialBindingPurpose();
    static TfTokenVector materialRenderContexts();
    static TfTokenVector renderSettingsNamespaces();
    static TfTokenVector shaderSourceTypes();
    TfToken GetMaterialBindingPurpose() const override { return materialBindingPurpose(); }
    TfTokenVector GetMaterialRenderContexts() const override { return materialRenderContexts(); }
    TfTokenVector GetRenderSettingsNamespaces() const override {
        return renderSettingsNamespaces();
    }
    TfTokenVector GetShaderSourceTypes() const override { return shaderSourceTypes(); }
#if PATINA_HAS_PARALLEL_SPRIM_SYNC
    bool IsParallelSyncEnabled(const TfToken& primType) const override;
#endif
    HdAovDescriptor GetDefaultAovDescriptor(const TfToken& name) const override;

    /// `patina:dumpScene` writes the scene as text to the argument `file`.
    HdCommandDescriptors GetCommandDescriptors() const override;
    bool InvokeCommand(const TfToken& command, const HdCommandArgs& args) override;

private:
    void applySettings();

    std::string _backend;
    std::shared_ptr<HdPatinaDelegateState> _state;
    HdResourceRegistrySharedPtr _registry;
};

} // namespace patina
