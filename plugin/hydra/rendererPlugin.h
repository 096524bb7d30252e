// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/rendererPlugin.h>

#include <string>

// Names of types that plugInfo.json gives hold no namespace, so this one class lives in OpenUSD's.
PXR_NAMESPACE_OPEN_SCOPE

/// The plugin that hosts load as "Patina". It needs no GPU; where there is one, contexts of its own
/// make the first images of interactive sessions, and never touch those of the host.
class HdPatinaRendererPlugin : public HdRendererPlugin {
public:
    HdPatinaRendererPlugin() : HdPatinaRendererPlugin("auto") {}

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
#if PATINA_HAS_SCENE_INDEX_CREATE_ARGS
    HdContainerDataSourceHandle GetSceneIndexCreateArgs() const override;
#endif

protected:
    /// @param backend default of the render setting `backend`
    explicit HdPatinaRendererPlugin(const char* backend) : _backend(backend) {}

private:
    const char* _backend;
};

/// "Patina GL": the same, rasterizing. Where it finds no OpenGL it path traces, with a warning, so
/// that a host may always offer it.
class HdPatinaRasterRendererPlugin final : public HdPatinaRendererPlugin {
public:
    HdPatinaRasterRendererPlugin() : HdPatinaRendererPlugin("raster") {}
};

PXR_NAMESPACE_CLOSE_SCOPE
