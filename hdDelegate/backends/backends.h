// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/hostDevice.h"
#include "hdDelegate/renderer/renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Names that makeBackend() knows: embree (path tracer), raster (rasterizer), interactive (the
/// rasterizer's image at once, refined by path tracing) and auto (interactive where there is a GPU;
/// where OpenGL is software it would only take the path tracer's cores, and embree is made).
const std::vector<std::string>& backendNames();

/// Makes a renderer by name; null for an unknown name.
///
/// If there is no OpenGL 4.5, or the driver fails during a render, raster falls back to the path
/// tracer, and interactive continues without its first image. The scene's diagnostics say so, once.
/// RenderProgress::backend names the back end that made an image.
/// @param device that its images are drawn on, if it can; null: on one of its own
std::unique_ptr<Renderer> makeBackend(const std::string& name,
                                      const std::shared_ptr<HostDevice>& device = nullptr);

/// The device whose context of OpenGL is current on this thread.
/// @returns null, with a one-line reason, where images cannot be drawn on it, and without one where
/// no context is current
std::shared_ptr<HostDevice> currentHostDevice(std::string& why);
/// Whether a back end of that name rasterizes here.
bool rasterizes(const std::string& name);

} // namespace patina
