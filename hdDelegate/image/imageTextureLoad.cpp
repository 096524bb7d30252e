// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/imageTextureLoad.h"

#include "hdDelegate/parallel.h"
#include "materialNetwork/limits.h"
#include "materialNetwork/regularFile.h"

#include <OpenImageIO/half.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace patina {

namespace {

constexpr float largestHalf = 65504.0f;

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text;
}

TexelType nativeType(const OIIO::ImageSpec& s) {
    switch (s.format.basetype) {
    case OIIO::TypeDesc::UINT8: return TexelType::U8;
    case OIIO::TypeDesc::UINT16: return TexelType::U16;
    case OIIO::TypeDesc::HALF: return TexelType::Half;
    default: return TexelType::Float;
    }
}

OIIO::TypeDesc oiioType(TexelType type) {
    static const OIIO::TypeDesc types[] = {OIIO::TypeUInt8, OIIO::TypeUInt16, OIIO::TypeHalf,
                                           OIIO::TypeFloat};
    return types[int(type)];
}

/// An open file, or the reason why there is none.
struct OpenImage {
    std::unique_ptr<OIIO::ImageInput> input;
    std::string error;
    TexelLayout layout = TexelLayout::Rgb;

    explicit OpenImage(const std::string& file) {
        const std::string problem = whyNoImage(file);
        if (!problem.empty()) {
            error = "the file " + problem;
            return;
        }
        OIIO::ImageSpec hints;
        hints.attribute("oiio:UnassociatedAlpha",
                        1); // texels as stored: premultiplying loses colour
        input = OIIO::ImageInput::open(file, &hints);
        if (!input) {
            error = oneLine(OIIO::geterror());
            if (error.empty()) error = "it cannot be read";
            return;
        }
        const OIIO::ImageSpec& s = input->spec();
        if (s.width < 1 || s.height < 1 || s.nchannels < 1 || s.depth > 1) {
            error = "an image of " + std::to_string(s.width) + "x" + std::to_string(s.height) +
                    "x" + std::to_string(s.depth) + " is not a texture";
            input.reset();
            return;
        }
        layout = layoutOf(s);
        const int channels = std::min(s.nchannels, 4);
        const uint64_t texels = uint64_t(s.width) * uint64_t(s.height);
        // A file of some hundred kB can ask for any number of them.
        const uint64_t each = uint64_t(channels) * oiioType(nativeType(s)).size();
        if (texels > limitOf(Limit::textureBytes) / each) {
            error = "an image of " + std::to_string(s.width) + "x" + std::to_string(s.height) +
                    " texels takes more bytes than " + limitText(Limit::textureBytes);
            input.reset();
        }
    }

private:
    static TexelLayout layoutOf(const OIIO::ImageSpec& s) {
        if (s.nchannels == 1) return TexelLayout::Grey;
        if (s.nchannels == 2) {
            bool redGreen = s.channelnames.size() > 1 && s.channelnames[1] == "G";
            return redGreen ? TexelLayout::RedGreen : TexelLayout::GreyAlpha;
        }
        bool alpha = s.nchannels > 3 && (s.alpha_channel == 3 || s.nchannels == 4);
        return alpha ? TexelLayout::Rgba : TexelLayout::Rgb;
    }
};

// OIIO says sRGB of every PNG and JPEG, tagged or not; so only a claim of linearity is news.
std::string automaticSpace(const OIIO::ImageSpec& s) {
    std::string claim = s.get_string_attribute("oiio:ColorSpace");
    bool linear = OIIO::Strutil::iequals(claim, "linear") ||
                  s.get_float_attribute("oiio:Gamma", 0.0f) == 1.0f;
    bool eightBitColor = s.format == OIIO::TypeUInt8 && s.nchannels >= 3;
    return eightBitColor && !linear ? "srgb_texture" : "raw";
}

/// Fills the table of an 8-bit decode. @returns false when the transform mixes channels or falls.
bool decodeTable(const ColorTransform& transform, std::array<float, 256>& table) {
    auto apply = [&](int r, int g, int b) {
        glm::vec3 c = glm::vec3(r, g, b) / 255.0f;
        transform.apply(&c.x, 1, 3);
        return c;
    };
    auto close = [](float a, float b) {
        return std::abs(a - b) <= 2e-6f * std::max(1.0f, std::abs(b));
    };
    for (int i = 0; i < 256; ++i) {
        glm::vec3 c = apply(i, i, i);
        if (!close(c.r, c.g) || !close(c.b, c.g)) return false;
        table[size_t(i)] = c.g;
        if (i && !(table[size_t(i)] >= table[size_t(i) - 1])) return false;
    }
    for (int i = 0; i < 256; i += 5) {
        int r = i, g = (i * 7 + 60) & 255, b = 255 - i;
        glm::vec3 c = apply(r, g, b);
        if (!close(c.r, table[size_t(r)]) || !close(c.g, table[size_t(g)]) ||
            !close(c.b, table[size_t(b)]))
            return false;
    }
    return true;
}

float toFloat(uint8_t v) {
    return float(v) * (1.0f / 255.0f);
}
float toFloat(uint16_t v) {
    return float(v) * (1.0f / 65535.0f);
}
float toFloat(half v) {
    return float(v);
}
float toFloat(float v) {
    return v;
}

void assign(float v, half& to) {
    to = half(std::min(std::max(v, -largestHalf), largestHalf));
}
void assign(float v, float& to) {
    to = v;
}

/// Converts one row; source and target may be the same memory when their types are.
template <class From, class To> void convertRow(const From* from, To* to, int width,
                                                TexelLayout layout, const ColorTransform& transform,
                                                std::atomic<size_t>& bad) {
    const size_t n = size_t(channelCount(layout));
    const bool grey = layout == TexelLayout::Grey || layout == TexelLayout::GreyAlpha;
    const size_t colors = grey ? 1 : std::min<size_t>(n, 3);
    std::vector<float> row(size_t(width) * 4, 0.0f);
    size_t badHere = 0;
    for (size_t x = 0; x < size_t(width); ++x)
        for (size_t c = 0; c < n; ++c) {
            float v = toFloat(from[x * n + c]);
            if (!std::isfinite(v)) v = 0.0f, ++badHere;
            if (grey && c == 0)
                row[x * 4] = row[x * 4 + 1] = row[x * 4 + 2] = v;
            else
                row[x * 4 + (c < colors ? c : 3)] = v;
        }
    if (badHere) bad += badHere;
    transform.apply(row.data(), size_t(width), 4);
    for (size_t x = 0; x < size_t(width); ++x)
        for (size_t c = 0; c < n; ++c)
            // of a grey image green, which every transform that keeps white carries through
            assign(row[x * 4 + (c < colors ? (grey ? 1 : c) : 3)], to[x * n + c]);
}

template <class From, class To> size_t convertRows(const void* from, void* to, int width,
                                                   int height, TexelLayout layout,
                                                   const ColorTransform& transform) {
    std::atomic<size_t> bad{0};
    const size_t rowSize = size_t(width) * size_t(channelCount(layout));
    parallelFor(0, height, [&](int y) {
        convertRow(static_cast<const From*>(from) + size_t(y) * rowSize,
                   static_cast<To*>(to) + size_t(y) * rowSize, width, layout, transform, bad);
    });
    return bad;
}

template <class To> size_t convertFrom(TexelType type, const void* from, void* to, int width,
                                       int height, TexelLayout layout,
                                       const ColorTransform& transform) {
    switch (type) {
    case TexelType::U8: return convertRows<uint8_t, To>(from, to, width, height, layout, transform);
    case TexelType::U16:
        return convertRows<uint16_t, To>(from, to, width, height, layout, transform);
    case TexelType::Half: return convertRows<half, To>(from, to, width, height, layout, transform);
    case TexelType::Float: break;
    }
    return convertRows<float, To>(from, to, width, height, layout, transform);
}

/// A transform that must exist: an unknown name becomes data, with a warning.
ColorTransformPtr transformOf(const ImageSource& source, const OIIO::ImageSpec& spec,
                              const ColorSpaces& colorSpaces, Diagnostics& diagnostics) {
    std::string name = OIIO::Strutil::iequals(source.colorSpace, "auto") ? automaticSpace(spec)
                                                                         : source.colorSpace;
    ColorTransformPtr transform = colorSpaces.toRendering(name);
    if (transform) return transform;
    diagnostics.warn(source.prim, source.input,
                     "unknown colour space '" + name + "' of '" + source.file +
                         "'; its values are used as they are");
    return colorSpaces.toRendering("raw");
}

std::shared_ptr<ImageTexture> unreadable(const ImageSource& source, const std::string& reason,
                                         Diagnostics& diagnostics) {
    diagnostics.warn(source.prim, source.input,
                     "texture '" + source.file + "': " + reason + "; magenta is shown");
    return nullptr;
}

} // namespace

std::string probeImage(const std::string& file, TexelLayout& layout) {
    OpenImage image(file);
    layout = image.layout;
    return image.error;
}

std::shared_ptr<ImageTexture> loadImageTexture(const ImageSource& source,
                                               const ColorSpaces& colorSpaces,
                                               Diagnostics& diagnostics) try {
    OpenImage image(source.file);
    if (!image.input) return unreadable(source, image.error, diagnostics);
    const OIIO::ImageSpec spec = image.input->spec();
    const TexelLayout layout = image.layout;
    const int channels = channelCount(layout);
    ColorTransformPtr transform = transformOf(source, spec, colorSpaces, diagnostics);

    const TexelType file = nativeType(spec);
    TexelType stored = file;
    std::array<float, 256> table;
    bool asRead = transform->isIdentity() && (file == TexelType::U8 || file == TexelType::U16);
    if (file == TexelType::U8 && !asRead) {
        asRead = decodeTable(*transform, table);
        if (!asRead) stored = TexelType::Half;
    }
    if (file == TexelType::U16 && !asRead) stored = TexelType::Float;
    // Radiance's eight bits of mantissa fit into half, unless the sun is in the picture.
    bool maybeHalf = OIIO::Strutil::iequals(image.input->format_name(), "hdr");

    std::unique_ptr<uint8_t[]> buffer;
    std::shared_ptr<ImageTexture> texture;
    void* target;
    if (stored == file && !maybeHalf) {
        texture = std::make_shared<ImageTexture>(spec.width, spec.height, layout, stored);
        target = texture->levelData(0);
    } else {
        buffer.reset(new uint8_t[size_t(spec.width) * size_t(spec.height) * size_t(channels) *
                                 oiioType(file).size()]);
        target = buffer.get();
    }
    // The TIFF reader says that all is well after a strip that it could not read.
    bool read = image.input->read_image(0, 0, 0, channels, oiioType(file), target);
    if (!read || image.input->has_error())
        return unreadable(source, oneLine(image.input->geterror()), diagnostics);

    // Isolated: a thread that waits here must not take up another task, which might want this very
    // texture.
    runIsolated([&] {
        if (maybeHalf) {
            const float* v = reinterpret_cast<const float*>(buffer.get());
            const float* end = v + size_t(spec.width) * size_t(spec.height) * size_t(channels);
            if (std::all_of(v, end, [](float f) { return !(std::abs(f) > largestHalf); }))
                stored = TexelType::Half;
        }
        if (!texture)
            texture = std::make_shared<ImageTexture>(spec.width, spec.height, layout, stored);
        if (asRead) {
            if (!transform->isIdentity()) texture->setDecodeTable(table);
        } else {
            void* to = texture->levelData(0);
            size_t bad =
                (stored == TexelType::Half ? convertFrom<half>
                                           : convertFrom<float>)(file, target, to, spec.width,
                                                                 spec.height, layout, *transform);
            if (bad)
                diagnostics.warn(source.prim, source.input,
                                 "texture '" + source.file + "' holds " + std::to_string(bad) +
                                     " values that are NaN or infinite; 0 is used for them");
        }
        buffer.reset();
        if (std::shared_ptr<ImageTexture> grey = texture->asGrey()) texture = std::move(grey);
        texture->buildPyramid();
    });
    return texture;
} catch (const std::bad_alloc&) {
    return unreadable(source, "there is not enough memory for it", diagnostics);
}

ImageRGB loadImageLinear(const std::string& file, const std::string& colorSpace,
                         Diagnostics& diagnostics, const std::string& prim,
                         const std::string& input) {
    ImageRGB result;
    std::shared_ptr<ImageTexture> texture =
        loadImageTexture({file, colorSpace, prim, input}, ColorSpaces::shared(), diagnostics);
    if (!texture) {
        result.width = result.height = 1;
        result.pixels = {glm::vec3(1, 0, 1)};
        return result;
    }
    result.valid = true;
    result.width = texture->width();
    result.height = texture->height();
    result.pixels.resize(size_t(result.width) * size_t(result.height));
    parallelFor(0, result.height, [&](int y) {
        for (int x = 0; x < result.width; ++x)
            result.pixels[size_t(y) * size_t(result.width) + size_t(x)] =
                glm::vec3(texture->texel(0, x, y));
    });
    return result;
}

} // namespace patina
