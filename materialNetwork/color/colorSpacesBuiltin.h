// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <array>
#include <string>

namespace patina {

/// Chromaticities (CIE 1931 xy) of red, green, blue and white.
struct Primaries {
    double red[2], green[2], blue[2], white[2];
};

/// Row-major matrix from linear RGB of the primaries to linear Rec.709; another white is adapted by
/// Bradford's transform (Lam 1985).
std::array<double, 9> matrixToRec709(const Primaries& primaries);

/// The way to linear Rec.709 from a space written as ColorSpaces says.
/// @returns null for what is not written so, or describes no space
OCIO_NAMESPACE::ConstTransformRcPtr parseChromaticities(const std::string& text);

/// The configuration that is used where the user brings none. Its reference space is lin_rec709.
OCIO_NAMESPACE::ConstConfigRcPtr builtinColorConfig();

} // namespace patina
