// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/texelFormat.h"
#include "materialNetwork/color/colorSpaces.h"

namespace patina {

/// How the texels of a file become those that are stored. 8-bit files stay 8-bit where their
/// colour space works channel by channel; 16-bit data stays 16-bit; half stays half.
class TexelConversion {
public:
    TexelConversion(TexelLayout layout, TexelType file, ColorTransformPtr transform);

    const TexelFormat& format() const { return _format; } ///< of what is stored
    TexelType fileType() const { return _file; }
    bool isAsRead() const { return _asRead; } ///< texels are stored as the file has them
    /// Floats that fit are stored as half.
    void storeHalf() { _format.type = TexelType::Half; }

    /// Converts texels of one row. Both may be the same memory where their types are.
    /// @returns how many values were NaN or infinite; they are 0
    size_t row(const void* from, void* to, int width) const;

private:
    TexelFormat _format;
    TexelType _file;
    ColorTransformPtr _transform;
    bool _asRead;
};

constexpr float largestHalf = 65504.0f;

} // namespace patina
