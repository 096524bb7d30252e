// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/textureSource.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace patina {

enum class TexelType : uint8_t { U8, U16, Half, Float };

/// Meaning of the channels of a texture; its size is channelCount().
enum class TexelLayout : uint8_t { Grey, GreyAlpha, RedGreen, Rgb, Rgba };
int channelCount(TexelLayout layout);

/// A decoded image with its mip pyramid, as the texture unit of a GPU would hold it. Texels are
/// stored compactly and read as linear Rec.709 floats. Level 0 is the file; each further level
/// halves (rounding down, as OpenGL does) and averages in linear light, weighted by area.
///
/// Sampling follows OpenGL 4.6, section 8.14: texel centres at half integers, lambda =
/// log2(footprint * larger side), bilinear below 0, linear between levels above. A GLSL sampler
/// over the same levels (uploaded with the rows upside down, as OpenGL counts them from the
/// bottom) gives the same with textureLod(s, uv, lambda).
class ImageTexture {
public:
    struct Level {
        int width, height;
        size_t offset; ///< of its first texel
    };

    /// Room for all levels, not yet filled.
    /// @throws std::bad_alloc
    ImageTexture(int width, int height, TexelLayout layout, TexelType type);

    int width() const { return _levels[0].width; }
    int height() const { return _levels[0].height; }
    int channels() const { return _channels; }
    TexelLayout layout() const { return _layout; }
    TexelType type() const { return _type; }
    const std::vector<Level>& levels() const { return _levels; }
    size_t memoryBytes() const;

    /// Texels of a level, top row first, without padding.
    void* levelData(int level);
    const void* levelData(int level) const;

    /// How 8-bit colour becomes linear light; it must not fall. Alpha is never decoded.
    /// The default divides by 255.
    void setDecodeTable(const std::array<float, 256>& table);

    /// Grey images are often saved as colour: level 0 with one channel in place of three that are
    /// equal in every texel, to the bit. Samples of it are the same; its pyramid is not
    /// built yet.
    /// @returns null where a texel has a colour, or there is no third channel
    /// @throws std::bad_alloc
    std::shared_ptr<ImageTexture> asGrey() const;

    /// Fills the levels above 0, with all threads.
    void buildPyramid();

    /// @param uv v up. Values that are not finite count as 0.
    /// @param footprint width of the filter in uv units
    glm::vec4 sample(glm::vec2 uv, float footprint, TextureWrap wrapS, TextureWrap wrapT) const;
    /// The texel that uv lies in, of level 0.
    glm::vec4 sampleNearest(glm::vec2 uv, TextureWrap wrapS, TextureWrap wrapT) const;
    /// One texel, row 0 at the top.
    glm::vec4 texel(int level, int x, int y) const;

private:
    glm::vec4 bilinear(int level, glm::vec2 st, TextureWrap wrapS, TextureWrap wrapT) const;
    glm::vec4 expand(const float* channels) const;
    template <class T, int N> void addFour(const Level& level, const int* x, const int* y,
                                           const float* weights, float* sum) const;
    template <class T, int N> void buildLevel(int level);
    template <class T> bool takeGrey(const ImageTexture& colored);
    const float* lastTable() const; ///< decodes the last channel: alpha differs from colour

    /// Chosen once, by type and channels.
    struct Functions {
        void (ImageTexture::*addFour)(const Level& level, const int* x, const int* y,
                                      const float* weights, float* sum) const;
        void (ImageTexture::*buildLevel)(int level);
    };
    template <class T> static Functions functionsOf(int channels);

    int _channels;
    TexelLayout _layout;
    TexelType _type;
    Functions _functions;
    std::vector<Level> _levels;
    size_t _texels = 0;
    std::unique_ptr<uint8_t[]> _data;
    std::array<float, 256> _decode, _plain; ///< of 8-bit colour and of 8-bit alpha
};

} // namespace patina
