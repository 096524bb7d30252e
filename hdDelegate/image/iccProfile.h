// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/color/colorSpacesBuiltin.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace patina {

/// A curve from encoded to linear values as ColorSpaces write it: an exponent, with an offset that
/// makes it linear towards black (2.4 and 0.055 for sRGB), or without (0).
struct CurveShape {
    double gamma = 1.0, offset = 0.0;
};

/// @param primaries null: those of Rec.709
/// @returns "raw" and "srgb_texture" where it is linear Rec.709 or sRGB but for rounding
std::string spaceOf(const Primaries* primaries, const CurveShape& curve);

/// The colour space of an ICC profile (ICC.1:2022) made of a matrix and one curve, or of a curve
/// for grey. Of profiles made of tables those are known that are called sRGB.
/// @returns empty for others, and for bytes that are no profile
std::string spaceOfIccProfile(const uint8_t* bytes, size_t size);

} // namespace patina
