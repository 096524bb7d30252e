// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"

#include <memory>
#include <string>

namespace patina {

/// Makes the rasterizing back end: direct light by OpenGL, without a display. Passes add up to soft
/// shadows, depth of field, motion blur of transforms and transparency.
///
/// Approximations: light between surfaces is left out; what refracts shows the environment, not the
/// scene behind; highlights found by sampling the BSDF are shadowed approximately; subsurface
/// scattering shows as diffuse; coloured transparency
/// does not colour what lies behind; media are not shown (which warns).
/// @returns null with a one-line reason where there is no OpenGL 4.5
std::unique_ptr<Renderer> makeRasterRenderer(std::string& error);

/// Whether EGL knows a device that is not software. Quick: no driver is loaded for the answer.
bool hasGpu();

} // namespace patina
