// SPDX-License-Identifier: Apache-2.0
#include "plugin/hydra/rendererPlugin.h"

#include "hdDelegate/hydra/renderDelegate.h"
#include "plugin/hydra/support.h"

#include <pxr/base/tf/diagnostic.h>
#include <pxr/imaging/hd/rendererPluginRegistry.h>
#if PATINA_HAS_SCENE_INDEX_CREATE_ARGS
#include <pxr/imaging/hd/renderDelegateInfo.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/sceneIndexCreateArgsSchema.h>
#endif

#include <exception>

PXR_NAMESPACE_OPEN_SCOPE

TF_REGISTRY_FUNCTION(TfType) {
    HdRendererPluginRegistry::Define<HdPatinaRendererPlugin>();
    HdRendererPluginRegistry::Define<HdPatinaRasterRendererPlugin>();
}

HdRenderDelegate* HdPatinaRendererPlugin::CreateRenderDelegate() {
    return CreateRenderDelegate(HdRenderSettingsMap());
}

HdRenderDelegate*
HdPatinaRendererPlugin::CreateRenderDelegate(const HdRenderSettingsMap& settings) {
    try {
        return new patina::HdPatinaRenderDelegate(settings, _backend);
    } catch (const std::exception& error) {
        TF_RUNTIME_ERROR("Patina cannot start: %s", error.what());
        return nullptr;
    }
}

void HdPatinaRendererPlugin::DeleteRenderDelegate(HdRenderDelegate* delegate) {
    delete delegate;
}

#if PATINA_HAS_CREATE_ARGS_SCHEMA
bool HdPatinaRendererPlugin::IsSupported(const HdRendererCreateArgsSchema&,
                                         std::string* reasonWhyNot) const {
    return patina::isSupported(reasonWhyNot);
}
#elif PATINA_HAS_CREATE_ARGS
bool HdPatinaRendererPlugin::IsSupported(const HdRendererCreateArgs&,
                                         std::string* reasonWhyNot) const {
    return patina::isSupported(reasonWhyNot);
}

bool HdPatinaRendererPlugin::IsSupported(bool) const {
    return patina::isSupported(nullptr);
}
#else
bool HdPatinaRendererPlugin::IsSupported(bool) const {
    return patina::isSupported(nullptr);
}
#endif

#if PATINA_HAS_SCENE_INDEX_CREATE_ARGS
HdContainerDataSourceHandle HdPatinaRendererPlugin::GetSceneIndexCreateArgs() const {
    using patina::HdPatinaRenderDelegate;
    HdRenderDelegateInfo info;
    info.materialBindingPurpose = HdPatinaRenderDelegate::materialBindingPurpose();
    info.materialRenderContexts = HdPatinaRenderDelegate::materialRenderContexts();
    info.renderSettingsNamespaces = HdPatinaRenderDelegate::renderSettingsNamespaces();
    info.isPrimvarFilteringNeeded = false;
    info.shaderSourceTypes = HdPatinaRenderDelegate::shaderSourceTypes();
    info.isCoordSysSupported = true;
    const auto yes = HdRetainedTypedSampledDataSource<bool>::New(true);
    return HdSceneIndexCreateArgsSchema::Builder()
        .SetMotionBlurSupport(yes)
        .SetCameraMotionBlurSupport(yes)
        .SetLegacyRenderDelegateInfo(
            HdRetainedTypedSampledDataSource<HdRenderDelegateInfo>::New(info))
        .Build();
}
#endif

PXR_NAMESPACE_CLOSE_SCOPE
