// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageOutput.h"
#include "hdDelegate/parallel.h"
#include "materialNetwork/color/colorSpaces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {

namespace {

/// A number in [0,1) that depends on the pixel and nothing else.
float noise(uint32_t x, uint32_t y, uint32_t channel) {
    uint32_t h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ channel * 0xC2B2AE3Du;
    h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
    h = (h ^ (h >> 12)) * 0x297A2D39u;
    return float((h ^ (h >> 15)) >> 8) * (1.0f / 16777216.0f);
}

template <class T> void quantize(const std::vector<float>& from, std::vector<T>& to, int width,
                                 int channels, bool dither) {
    const float top = float(std::numeric_limits<T>::max());
    to.resize(from.size());
    const size_t rowSize = size_t(width) * size_t(channels);
    parallelFor(size_t(0), from.size() / rowSize, [&](size_t y) {
        for (size_t i = 0; i < rowSize; ++i) {
            uint32_t x = uint32_t(i / size_t(channels)), c = uint32_t(i % size_t(channels));
            float v = std::min(std::max(from[y * rowSize + i], 0.0f), 1.0f) * top;
            float shift = dither ? noise(x, uint32_t(y), c) : 0.5f;
            to[y * rowSize + i] = T(std::min(std::floor(v + shift), top));
        }
    });
}

/// Colour for a screen: straight alpha, display transform.
void toDisplay(std::vector<float>& pixels, int width, int height, int channels, bool straightAlpha,
               const ColorTransform* transform) {
    const size_t rowSize = size_t(width) * size_t(channels);
    parallelFor(0, height, [&](int y) {
        float* row = &pixels[size_t(y) * rowSize];
        if (straightAlpha)
            for (int x = 0; x < width; ++x) {
                float* p = row + x * channels;
                // Light without coverage (a glow) has no straight colour; it is kept as it is.
                if (p[3] > 0.0f && p[3] < 1.0f)
                    for (int c = 0; c < 3; ++c)
                        p[c] /= p[3];
            }
        if (!transform || transform->isIdentity()) return;
        if (channels >= 3) {
            transform->apply(row, size_t(width), channels);
            return;
        }
        for (int x = 0; x < width; ++x) {
            float grey[3] = {row[x], row[x], row[x]};
            transform->apply(grey, 1, 3);
            row[x] = grey[1];
        }
    });
}

} // namespace

void writeDisplayImage(const float* pixels, int channels, int sourceWidth,
                       const ImagePlacement& placement, const std::string& path,
                       const ImageOptions& options, const Metadata& metadata) {
    auto output = createOutput(path);
    const std::string format = output->format_name();
    const bool radiance = format == "hdr";
    const bool floats = radiance || (format == "tiff" && options.bits == 32);
    const bool alpha = channels == 4 && output->supports("alpha") && !radiance;
    const int written = channels == 4 && !alpha ? 3 : channels;

    std::vector<float> image(size_t(placement.width) * size_t(placement.height) * size_t(written));
    parallelFor(0, placement.height, [&](int y) {
        const float* from = pixels + (size_t(placement.sourceY + y) * size_t(sourceWidth) +
                                      size_t(placement.sourceX)) *
                                         size_t(channels);
        float* to = &image[size_t(y) * size_t(placement.width) * size_t(written)];
        for (int x = 0; x < placement.width; ++x, from += channels, to += written)
            std::copy(from, from + written, to);
    });

    OIIO::TypeDesc type = options.bits == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8;
    if (floats) type = OIIO::TypeFloat;
    OIIO::ImageSpec spec = makeSpec(placement, written, type, options, metadata);
    if (format != "tiff") { // others cannot place a window; the pixels stand alone
        spec.x = spec.y = 0;
        spec.full_width = spec.width;
        spec.full_height = spec.height;
    }
    spec.attribute("CompressionQuality", options.quality);
    bool linear = floats || options.raw;
    spec.attribute("oiio:ColorSpace", linear ? "Linear" : "sRGB");
    bool straight = alpha && !floats;
    if (straight) spec.attribute("oiio:UnassociatedAlpha", 1);

    ColorTransformPtr transform;
    if (!linear) {
        const ColorSpaces& spaces =
            options.colorSpaces ? *options.colorSpaces : ColorSpaces::shared();
        transform = spaces.display(options.display, options.view, *options.renderingSpace);
    }
    toDisplay(image, placement.width, placement.height, written, straight, transform.get());

    writeAtomically(path, spec, [&](OIIO::ImageOutput& out) {
        if (floats) return out.write_image(OIIO::TypeFloat, image.data());
        if (options.bits == 16) {
            std::vector<uint16_t> quantized;
            quantize(image, quantized, placement.width, written, options.dither);
            return out.write_image(OIIO::TypeUInt16, quantized.data());
        }
        std::vector<uint8_t> quantized;
        quantize(image, quantized, placement.width, written, options.dither);
        return out.write_image(OIIO::TypeUInt8, quantized.data());
    });
}

} // namespace patina
