// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <memory>
#include <string>

namespace patina {

/// Makes the rasterizing back end: direct light by OpenGL, without a display. Passes add up to soft
/// shadows, depth of field, motion blur of transforms and transparency.
///
/// It approximates more than the path tracer; docs/generated/byDesign.md lists the differences.
/// @returns null with a one-line reason if there is no OpenGL 4.5
std::unique_ptr<Renderer> makeRasterRenderer(std::string& error);

/// Whether EGL knows a device that is not software. Quick: no driver is loaded for the answer.
bool hasGpu();

} // namespace patina
