// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/materialProgram.h"
#include "materialNetwork/network/network.h"

namespace patina {

/// A simple material that looks much like another: for renderers that have to show something before
/// the other is ready. It is a UsdPreviewSurface of constants, which give back the mean reflectance
/// of the other seen from straight ahead, and how rough that is. Textures are taken by their means.
/// Light of its own, displacement and media are left out. Surfaces
/// that transmit are half transparent.
///
/// All such networks compile to one of two texts, for opaque ones and for all others, so that two
/// programs of a graphics processor draw any material.
Network makeStandInNetwork(const MaterialProgram& program);

/// Whether that looks like the other: not where it shows primvars beside texture coordinates, nor
/// where it is no surface.
bool hasStandIn(const MaterialProgram& program);

} // namespace patina
