// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/engine/glContext.h"

#include <pxr/base/vt/dictionary.h>
#include <pxr/usd/sdf/path.h>
#include <pxr/usd/usd/stage.h>

#include <memory>
#include <string>
#include <vector>

PXR_NAMESPACE_OPEN_SCOPE
class UsdImagingGLEngine;
PXR_NAMESPACE_CLOSE_SCOPE

namespace patina {

PXR_NAMESPACE_USING_DIRECTIVE

struct EngineOptions {
    std::string renderer = "HdPatinaRendererPlugin"; ///< plugin id
    SdfPath camera;
    int width = 64, height = 64;       ///< pixels
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
    /// @throws std::runtime_error when the file is not written
    void write(const std::string& file);

    /// What the renderer counts, of its last image.
    VtDictionary statistics() const;
    /// The device of OpenGL.
    const std::string& device() const { return _context.name(); }

private:
    GlContext _context;
    UsdStageRefPtr _stage;
    std::unique_ptr<UsdImagingGLEngine> _engine;
};

} // namespace patina
