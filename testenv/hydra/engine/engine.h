// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/engine/hostGl.h"

#include <pxr/base/vt/dictionary.h>
#include <pxr/usd/sdf/path.h>
#include <pxr/usd/usd/stage.h>

#include <memory>
#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE
class HdRenderBuffer;
class UsdImagingGLEngine;
PXR_NAMESPACE_CLOSE_SCOPE

namespace patina {

PXR_NAMESPACE_USING_DIRECTIVE

struct EngineOptions {
    std::string renderer = "HdPatinaRendererPlugin"; ///< plugin id
    SdfPath camera;
    std::string aov = "color";
    int width = 64, height = 64;       ///< pixels
    bool glx = false;                  ///< the context is of an X server
    bool mapped = false;               ///< images are written as they are in memory
    std::vector<std::string> settings; ///< KEY=VALUE each
};

/// UsdImagingGLEngine with one renderer and one camera, drawing into a colour buffer.
class Engine {
public:
    /// @throws std::runtime_error when the renderer does not start
    Engine(const UsdStageRefPtr& stage, const EngineOptions& options);
    ~Engine();

    /// Draws until the image has converged, and waits until it can be read.
    /// @returns seconds until the host's buffer held a first image, which may be coarse: of Patina
    /// less than the whole takes, of others the same
    double render();
    /// Draws the finished image again, with colour over what is selected, as hosts do.
    void select(const SdfPath& path, int times);
    /// Writes what a host shows: a texture, where the buffer gives one.
    /// @throws std::runtime_error when the file is not written
    void write(const std::string& file);

    /// What the renderer counts, of its last image.
    VtDictionary statistics() const;
    /// The device of OpenGL.
    const std::string& device() const { return _context.name(); }

private:
    HdRenderBuffer& buffer() const;

    EngineOptions _options;
    HostGl _context;
    UsdStageRefPtr _stage;
    std::unique_ptr<UsdImagingGLEngine> _engine;
};

} // namespace patina
