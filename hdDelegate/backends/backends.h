// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Names that makeBackend() knows: embree (path tracer), raster (rasterizer), interactive (the
/// rasterizer's image at once, refined by path tracing) and auto (interactive where there is a GPU;
/// where OpenGL is software it would only take the path tracer's cores, and embree is made).
const std::vector<std::string>& backendNames();

/// Makes a renderer by name; null for a name that is not known.
///
/// raster falls back to the path tracer where there is no OpenGL 4.5, or when the driver fails in
/// the middle of a render; interactive goes on without its first image then. The scene's
/// diagnostics say so, once. RenderProgress::backend says what made an image.
std::unique_ptr<Renderer> makeBackend(const std::string& name);

} // namespace patina
