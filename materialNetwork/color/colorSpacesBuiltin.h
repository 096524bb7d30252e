// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <OpenColorIO/OpenColorIO.h>

#include <glm/glm.hpp>

#include <array>
#include <optional>
#include <string>

namespace patina {

/// Chromaticities (CIE 1931 xy) of red, green, blue and white.
struct Primaries {
    double red[2], green[2], blue[2], white[2];
};

/// Row-major matrix from linear RGB of the primaries to linear Rec.709; another white is adapted by
/// Bradford's transform (Lam 1985).
std::array<double, 9> matrixToRec709(const Primaries& primaries);

/// From linear Rec.709 to CIE XYZ under D65, Y of white 1.
glm::dmat3 rec709ToXyz();

/// CIE 1931 xy of red, green, blue and white of a linear space of the built-in configuration.
/// @returns nothing for others, and for XYZ, whose axes are no colours
std::optional<std::array<float, 8>> builtinChromaticities(const std::string& name);

/// The way to linear Rec.709 from a space written as ColorSpaces says.
/// @returns null for what is not written so, or describes no space
OCIO_NAMESPACE::ConstTransformRcPtr parseChromaticities(const std::string& text);

/// The configuration that is used where the user brings none. Its reference space is lin_rec709.
OCIO_NAMESPACE::ConstConfigRcPtr builtinColorConfig();

} // namespace patina
