// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/texelFormat.h"
#include "materialNetwork/textureSource.h"

#include <memory>

namespace patina {

/// Texels of a texture that is not whole in memory, by square tiles. Thread safe.
class TexelTiles {
public:
    static constexpr int side = 64; ///< texels; tiles at the far edges are smaller

    struct Tile {
        const void* texels; ///< without padding; null: they cannot be read
        int width;
    };
    virtual ~TexelTiles() = default;
    /// @returns a tile that stays as it is until the same thread asks for another
    virtual Tile tile(int level, int column, int row) const = 0;
};

/// A decoded image with its mip pyramid, as the texture unit of a GPU would hold it. Texels are
/// stored compactly and read as linear Rec.709 floats. Level 0 is the file; each further level is
/// the file's own, or averages in linear light (MipAverage). All are in memory, or read by tiles.
///
/// Sampling follows OpenGL 4.6, section 8.14: texel centres at half integers, lambda =
/// log2(footprint * larger side), bilinear below 0, linear between levels above. A GLSL sampler
/// over the same levels (uploaded with the rows upside down, as OpenGL counts them from the
/// bottom) gives the same with textureLod(s, uv, lambda).
class ImageTexture {
public:
    using Level = MipLevel;

    /// Room for all levels, not yet filled.
    /// @throws std::bad_alloc
    ImageTexture(int width, int height, TexelLayout layout, TexelType type);
    /// A texture whose texels are read when they are sampled. Where they cannot be, samples are
    /// magenta.
    ImageTexture(int width, int height, const TexelFormat& format,
                 std::unique_ptr<const TexelTiles> tiles);

    int width() const { return _levels[0].width; }
    int height() const { return _levels[0].height; }
    int channels() const { return channelCount(_format.layout); }
    TexelLayout layout() const { return _format.layout; }
    TexelType type() const { return _format.type; }
    const std::vector<Level>& levels() const { return _levels; }
    bool isWhole() const { return !_tiles; } ///< in memory
    size_t memoryBytes() const;              ///< of texels that are whole in memory

    /// Texels of a level, top row first, without padding. Of whole textures only, as is what
    /// follows up to sample().
    void* levelData(int level);
    const void* levelData(int level) const;

    /// How 8-bit colour becomes linear light; it must not fall. Alpha is never decoded.
    /// The default divides by 255.
    void setDecodeTable(const std::array<float, 256>& table);

    /// Grey images are often saved as colour: the first levels with one channel in place of three
    /// that are equal in every texel, to the bit. Samples of it are the same; its pyramid is
    /// not built yet.
    /// @param filled levels that hold texels
    /// @returns null where a texel has a colour, or there is no third channel
    /// @throws std::bad_alloc
    std::shared_ptr<ImageTexture> asGrey(int filled = 1) const;

    /// Fills the levels from a first one on, with all threads.
    void buildPyramid(int first = 1);

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
    bool addFour(int level, const int* x, const int* y, const float* weights, float* sum) const;
    bool addFourOfTiles(int level, const int* x, const int* y, const float* weights,
                        float* sum) const;
    template <class T> bool takeGrey(const ImageTexture& colored, int level);

    /// Adds four texels of an image, weighted. Chosen once, by type and channels.
    using AddFour = void (*)(const void* texels, int width, const int* x, const int* y,
                             const float* weights, const TexelFormat& format, float* sum);
    template <class T> static AddFour addFourOf(int channels);

    TexelFormat _format;
    AddFour _addFour;
    std::vector<Level> _levels;
    size_t _texels = 0;
    std::unique_ptr<uint8_t[]> _data;
    std::unique_ptr<const TexelTiles> _tiles;
};

} // namespace patina
