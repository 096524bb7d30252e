#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/rendererPlugin.h>

// Names of types that plugInfo.json gives hold no namespace, so this one class lives in OpenUSD's.
PXR_NAMESPACE_OPEN_SCOPE

/// What hosts load as "Patina". It needs no GPU and touches no graphics API.
class HdPatinaRendererPlugin final : public HdRendererPlugin {
public:
    HdRenderDelegate* CreateRenderDelegate() override;
    HdRenderDelegate* CreateRenderDelegate(const HdRenderSettingsMap& settings) override;
    void DeleteRenderDelegate(HdRenderDelegate* delegate) override;

#if PATINA_HAS_CREATE_ARGS_SCHEMA
    bool IsSupported(const HdRendererCreateArgsSchema& args,
                     std::string* reasonWhyNot) const override;
#elif PATINA_HAS_CREATE_ARGS
    bool IsSupported(const HdRendererCreateArgs& args,
                     std::string* reasonWhyNot = nullptr) const override;
    bool IsSupported(bool gpuEnabled) const override;
#else
    bool IsSupported(bool gpuEnabled) const override;
#endif
};

PXR_NAMESPACE_CLOSE_SCOPE
