// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace patina {

enum class TexelType : uint8_t { U8, U16, Half, Float };
size_t bytesOf(TexelType type); ///< of one channel

/// Meaning of the channels of a texture; its size is channelCount().
enum class TexelLayout : uint8_t { Grey, GreyAlpha, RedGreen, Rgb, Rgba };
int channelCount(TexelLayout layout);

/// How texels are stored, and how 8-bit ones are read.
struct TexelFormat {
    TexelLayout layout = TexelLayout::Rgb;
    TexelType type = TexelType::U8;
    std::array<float, 256> decode; ///< linear light of 8-bit colour; it must not fall
    std::array<float, 256> plain;  ///< of 8-bit alpha, which is never decoded: divided by 255

    TexelFormat(TexelLayout l, TexelType t);
    size_t texelBytes() const { return size_t(channelCount(layout)) * bytesOf(type); }
    /// The table of the last channel: alpha differs from colour.
    const std::array<float, 256>& last() const;
};

/// One level of a mip pyramid.
struct MipLevel {
    int width, height;
    size_t offset; ///< of its first texel, all levels behind each other
};

/// Each level halves the one before (rounding down, as OpenGL does), to a single texel.
std::vector<MipLevel> mipLevels(int width, int height);

} // namespace patina
