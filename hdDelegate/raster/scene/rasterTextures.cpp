// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterTextures.h"

#include <algorithm>

namespace patina {

namespace {

GLint wrapOf(TextureWrap wrap) {
    switch (wrap) {
    case TextureWrap::Black: return GL_CLAMP_TO_BORDER;
    case TextureWrap::Clamp: return GL_CLAMP_TO_EDGE;
    case TextureWrap::Mirror: return GL_MIRRORED_REPEAT;
    case TextureWrap::Repeat: break;
    }
    return GL_REPEAT;
}

/// Texels of an array, all layers and levels.
constexpr size_t largestArray = size_t(1) << 27;

} // namespace

struct RasterTextures::Layer {
    std::shared_ptr<const ImageTexture> image; ///< null: magenta
    TextureWrap wrapS, wrapT;
};

std::vector<std::shared_ptr<const GlTexture>>
RasterTextures::units(const std::vector<GlslTexture>& textures) {
    std::vector<std::shared_ptr<const GlTexture>> out;
    std::vector<const GlslTexture*> shared;
    for (const GlslTexture& t : textures)
        if (t.shared)
            shared.push_back(&t);
        else
            out.push_back(t.array ? array({&t}) : plain(t.handle));
    if (!shared.empty()) out.push_back(array(shared));
    return out;
}

/// All layers have the size of the largest, or less where that is too much.
std::shared_ptr<const GlTexture>
RasterTextures::array(const std::vector<const GlslTexture*>& textures) {
    std::vector<int> key;
    std::vector<Layer> layers;
    for (const GlslTexture* t : textures) {
        key.push_back(t->handle);
        const TextureTiling tiling = _textures.tiling(t->handle);
        if (t->tiles.empty())
            layers.push_back({_textures.image(t->handle), tiling.wrapS, tiling.wrapT});
        for (const int tile : t->tiles)
            layers.push_back(
                {_textures.image(t->handle, tile), TextureWrap::Clamp, TextureWrap::Clamp});
    }
    auto& known = _arrays[key];
    if (known) return known;
    int width = 1, height = 1;
    for (const Layer& layer : layers)
        if (layer.image) {
            width = std::max(width, layer.image->width());
            height = std::max(height, layer.image->height());
        }
    const int largest = largestTexture();
    GLint maxLayers = 0;
    gl.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
    const TextureRequest& request = _textures.request(textures[0]->handle);
    const int wanted = std::max(width, height);
    while (std::max(width, height) > 1 &&
           (std::max(width, height) > largest ||
            size_t(width) * size_t(height) * layers.size() > largestArray)) {
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
    if (std::max(width, height) < wanted)
        _diagnostics.warn(request.prim, request.input,
                          messages::udimTooLarge(request.file, width, height));
    const int count = std::min(int(layers.size()), int(maxLayers));
    auto texture =
        std::make_shared<GlTexture>(GL_TEXTURE_2D_ARRAY, _format, width, height, count, 0);
    for (int i = 0; i < count; ++i)
        upload(*texture, layers[size_t(i)], i);
    const bool nearest = textures.size() == 1 && request.nearest;
    texture->parameter(GL_TEXTURE_MIN_FILTER, nearest ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    texture->parameter(GL_TEXTURE_MAG_FILTER, nearest ? GL_NEAREST : GL_LINEAR);
    texture->parameter(GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    texture->parameter(GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return known = texture;
}

/// The level's own texels where the sizes agree, else filtered ones.
void RasterTextures::upload(const GlTexture& texture, const Layer& layer, int index) const {
    std::vector<glm::vec4> texels;
    for (int level = 0; level < texture.levels(); ++level) {
        const int w = std::max(1, texture.width() >> level);
        const int h = std::max(1, texture.height() >> level);
        texels.assign(size_t(w) * size_t(h), glm::vec4(1.0f, 0.0f, 1.0f, 1.0f));
        int own = -1;
        for (size_t l = 0; layer.image && l < layer.image->levels().size(); ++l)
            if (layer.image->levels()[l].width == w && layer.image->levels()[l].height == h)
                own = int(l);
        for (int y = 0; layer.image && y < h; ++y)
            for (int x = 0; x < w; ++x)
                texels[size_t(y) * size_t(w) + size_t(x)] =
                    own >= 0 ? layer.image->texel(own, x, h - 1 - y)
                             : layer.image->sample(
                                   {(float(x) + 0.5f) / float(w), (float(y) + 0.5f) / float(h)},
                                   1.0f / float(std::max(w, h)), layer.wrapS, layer.wrapT);
        gl.TextureSubImage3D(texture.id(), level, 0, 0, index, w, h, 1, GL_RGBA, GL_FLOAT,
                             texels.data());
    }
}

std::shared_ptr<const GlTexture> RasterTextures::plain(int handle) {
    auto& cached = _known[handle];
    if (cached) return cached;
    auto texture = std::make_shared<GlTexture>();
    const std::shared_ptr<const ImageTexture> image = _textures.image(handle);
    const glm::vec4 magenta(1.0f, 0.0f, 1.0f, 1.0f);
    if (!image) {
        *texture = GlTexture(GL_TEXTURE_2D, _format, 1, 1);
        gl.TextureSubImage2D(texture->id(), 0, 0, 0, 1, 1, GL_RGBA, GL_FLOAT, &magenta);
        return cached = texture;
    }
    const int largest = largestTexture();
    const auto& levels = image->levels();
    size_t first = 0;
    while (first + 1 < levels.size() &&
           std::max(levels[first].width, levels[first].height) > largest)
        ++first;
    const TextureRequest& request = _textures.request(handle);
    const auto size = [&](size_t level) {
        return std::to_string(levels[level].width) + " x " + std::to_string(levels[level].height);
    };
    if (first > 0)
        _diagnostics.warn(request.prim, request.input,
                          messages::textureTooLarge(request.file, size(0), largest, size(first)));
    // One number per texel where all are grey. With a border of no alpha there is one more.
    const bool grey = image->layout() == TexelLayout::Grey && request.wrapS != TextureWrap::Black &&
                      request.wrapT != TextureWrap::Black;
    const GLenum format = !grey ? _format : _format == GL_RGBA16F ? GL_R16F : GL_R32F;
    *texture = GlTexture(GL_TEXTURE_2D, format, levels[first].width, levels[first].height, 1,
                         int(levels.size() - first));
    const size_t count = grey ? 1 : 4;
    std::vector<float> texels;
    for (size_t l = first; l < levels.size(); ++l) {
        const int w = levels[l].width, h = levels[l].height;
        texels.resize(size_t(w) * size_t(h) * count);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const glm::vec4 texel = image->texel(int(l), x, y);
                const size_t at = size_t(h - 1 - y) * size_t(w) + size_t(x);
                std::copy_n(&texel.x, count, &texels[at * count]);
            }
        gl.TextureSubImage2D(texture->id(), GLint(l - first), 0, 0, w, h, grey ? GL_RED : GL_RGBA,
                             GL_FLOAT, texels.data());
    }
    if (grey) {
        texture->parameter(GL_TEXTURE_SWIZZLE_G, GL_RED);
        texture->parameter(GL_TEXTURE_SWIZZLE_B, GL_RED);
        texture->parameter(GL_TEXTURE_SWIZZLE_A, GL_ONE);
    }
    texture->parameter(GL_TEXTURE_MIN_FILTER,
                       request.nearest ? GL_NEAREST : GL_LINEAR_MIPMAP_LINEAR);
    texture->parameter(GL_TEXTURE_MAG_FILTER, request.nearest ? GL_NEAREST : GL_LINEAR);
    texture->parameter(GL_TEXTURE_WRAP_S, wrapOf(request.wrapS));
    texture->parameter(GL_TEXTURE_WRAP_T, wrapOf(request.wrapT));
    return cached = texture;
}

} // namespace patina
