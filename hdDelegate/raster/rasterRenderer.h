// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/hostContext.h"
#include "hdDelegate/renderer/renderer.h"

#include <memory>
#include <string>

namespace patina {

/// Makes the rasterizing back end: direct light by OpenGL, without a display. Passes add up to soft
/// shadows, depth of field, motion blur of transforms and transparency.
///
/// It approximates more than the path tracer; docs/generated/byDesign.md lists the differences.
/// @param host whose device images stay on; null: they are drawn on a device of their own
/// @returns null with a one-line reason if there is no OpenGL 4.5
std::unique_ptr<Renderer> makeRasterRenderer(std::string& error,
                                             std::shared_ptr<HostContext> host = nullptr);

/// Whether EGL knows a device that is not software. Quick: no driver is loaded for the answer.
bool hasGpu();

} // namespace patina
