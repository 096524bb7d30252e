// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/texelFormat.h"

#include <memory>

namespace patina {

class TexelEncoder;

/// Part of a level: columns [x0, x1) of rows [y0, y1).
struct TexelBlock {
    int x0, y0, x1, y1;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

/// Makes texels of a mip level from the stored texels of the finer one: averages in linear light,
/// weighted by area. Whole levels and tiles of them are made here, with the same bits.
class MipAverage {
public:
    explicit MipAverage(const TexelFormat& format);
    ~MipAverage();

    /// The texels of the finer level that a block needs.
    static TexelBlock sources(const MipLevel& from, const MipLevel& to, const TexelBlock& block);

    /// @param source texels of the finer level that `held` names, without padding
    /// @param target receives the block's texels, without padding
    void make(const MipLevel& from, const MipLevel& to, const void* source, const TexelBlock& held,
              void* target, const TexelBlock& block) const;

private:
    template <class T, int N> void makeBlock(const MipLevel& from, const MipLevel& to,
                                             const void* source, const TexelBlock& held,
                                             void* target, const TexelBlock& block) const;
    using Function = void (MipAverage::*)(const MipLevel&, const MipLevel&, const void*,
                                          const TexelBlock&, void*, const TexelBlock&) const;
    template <class T> static Function functionOf(int channels);

    const TexelFormat _format;
    Function _function;
    std::unique_ptr<const TexelEncoder> _encodeColor, _encodeLast; ///< of 8-bit texels
};

} // namespace patina
