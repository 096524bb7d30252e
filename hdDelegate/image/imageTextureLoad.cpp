// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/imageTextureLoad.h"

#include "hdDelegate/image/fileColorSpace.h"
#include "hdDelegate/image/fileTiles.h"
#include "hdDelegate/image/texelConversion.h"
#include "hdDelegate/image/textureFile.h"
#include "hdDelegate/parallel.h"
#include "base/limits.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace patina {

namespace {

/// A transform that must exist: an unknown name becomes data, with a warning.
ColorTransformPtr transformOf(const ImageSource& source, const TextureFile& file,
                              const ColorSpaces& colorSpaces, Diagnostics& diagnostics) {
    const RenderingSpace& to = *source.renderingSpace;
    std::string name = source.colorSpace;
    bool unread = false;
    if (OIIO::Strutil::iequals(name, "auto"))
        name =
            automaticSpace(source.file, file.input->format_name(), file.spec, colorSpaces, unread);
    if (unread)
        diagnostics.warn(source.prim, source.input, messages::iccProfileUnread(source.file, name));
    ColorTransformPtr transform = colorSpaces.toRendering(name, to);
    if (transform) return transform;
    diagnostics.warn(source.prim, source.input, messages::fileSpaceUnknown(name, source.file));
    return colorSpaces.toRendering("raw", to);
}

std::shared_ptr<ImageTexture> unreadable(const ImageSource& source, const std::string& reason,
                                         Diagnostics& diagnostics) {
    diagnostics.warn(source.prim, source.input, messages::textureUnreadable(source.file, reason));
    return nullptr;
}

/// Radiance's eight bits of mantissa fit into half, unless the sun is in the picture.
bool isRadiance(const TextureFile& file) {
    return OIIO::Strutil::iequals(file.input->format_name(), "hdr");
}

bool fitsHalf(const float* v, size_t count) {
    return std::all_of(v, v + count, [](float f) { return !(std::abs(f) > largestHalf); });
}

/// Looks through a file strip by strip.
bool fitsHalf(TextureFile& file, std::string& error) {
    constexpr int rows = 64;
    const OIIO::ImageSpec& s = file.spec;
    const size_t row = size_t(s.width) * size_t(channelCount(file.layout));
    std::vector<float> strip(row * rows);
    bool fits = true;
    for (int y = 0; y < s.height; y += rows) {
        const int end = std::min(y + rows, s.height);
        if (!file.input->read_scanlines(0, 0, s.y + y, s.y + end, 0, 0, channelCount(file.layout),
                                        OIIO::TypeFloat, strip.data())) {
            error = oneLine(file.input->geterror());
            if (error.empty()) error = "it cannot be read";
            return false;
        }
        fits = fits && fitsHalf(strip.data(), row * size_t(end - y));
    }
    return fits;
}

ImageHeader headerOf(const TextureFile& image) {
    ImageHeader header;
    header.problem = image.error;
    header.layout = image.layout;
    if (!image.input) return header;
    header.wrapModes = image.spec.get_string_attribute("wrapmodes");
    header.bytes = image.bytes();
    // A file of some hundred kB can ask for any number of texels.
    const uint64_t each = TexelFormat(image.layout, texelTypeOf(image.spec)).texelBytes();
    const uint64_t texels = uint64_t(image.spec.width) * uint64_t(image.spec.height);
    if (texels > limitOf(Limit::textureBytes) / each)
        header.tooLarge = "an image of " + std::to_string(image.spec.width) + "x" +
                          std::to_string(image.spec.height) + " texels takes more bytes than " +
                          limitText(Limit::textureBytes);
    return header;
}

/// Lights hold their images as floats, and number the texels by 32 bits.
std::string tooLargeForALight(const std::string& name) {
    const TextureFile image(name);
    if (!image.input) return {};
    const uint64_t texels = uint64_t(image.spec.width) * uint64_t(image.spec.height);
    if (texels <= std::min<uint64_t>(limitOf(Limit::textureBytes) / 4, INT32_MAX)) return {};
    return "an image of " + std::to_string(image.spec.width) + "x" +
           std::to_string(image.spec.height) +
           " texels is too large for a light: it takes more "
           "bytes than " +
           limitText(Limit::textureBytes);
}

} // namespace

ImageHeader probeImage(const std::string& file) {
    return headerOf(TextureFile(file));
}

std::shared_ptr<ImageTexture> loadImageTexture(const ImageSource& source,
                                               const ColorSpaces& colorSpaces,
                                               Diagnostics& diagnostics) try {
    TextureFile file(source.file);
    if (!file.input) return unreadable(source, file.error, diagnostics);
    const ImageHeader header = headerOf(file);
    if (!header.tooLarge.empty()) return unreadable(source, header.tooLarge, diagnostics);
    const OIIO::ImageSpec& spec = file.spec;
    TexelConversion conversion(file.layout, texelTypeOf(spec),
                               transformOf(source, file, colorSpaces, diagnostics));
    const bool maybeHalf = isRadiance(file);
    const bool direct = conversion.format().type == conversion.fileType() && !maybeHalf;
    const size_t fileTexel = TexelFormat(file.layout, conversion.fileType()).texelBytes();

    std::unique_ptr<uint8_t[]> buffer;
    std::shared_ptr<ImageTexture> texture;
    const std::vector<MipLevel> sizes = mipLevels(spec.width, spec.height);
    const auto makeTexture = [&] {
        texture = std::make_shared<ImageTexture>(spec.width, spec.height, file.layout,
                                                 conversion.format().type);
        texture->setDecodeTable(conversion.format().decode);
    };
    if (direct)
        makeTexture();
    else
        buffer.reset(new uint8_t[(sizes[size_t(file.levels) - 1].offset +
                                  size_t(sizes[size_t(file.levels) - 1].width) *
                                      size_t(sizes[size_t(file.levels) - 1].height)) *
                                 fileTexel]);
    const auto target = [&](int level) -> uint8_t* {
        return direct ? static_cast<uint8_t*>(texture->levelData(level))
                      : buffer.get() + sizes[size_t(level)].offset * fileTexel;
    };
    for (int level = 0; level < file.levels; ++level) {
        const bool read = file.input->read_image(0, level, 0, channelCount(file.layout),
                                                 typeOf(conversion.fileType()), target(level));
        // The TIFF reader says that all is well after a strip that it could not read.
        if (!read || file.input->has_error())
            return unreadable(source, oneLine(file.input->geterror()), diagnostics);
    }

    // Isolated: a thread that waits here must not take up another task, which might want this very
    // texture.
    runIsolated([&] {
        if (maybeHalf &&
            fitsHalf(reinterpret_cast<const float*>(buffer.get()),
                     size_t(spec.width) * size_t(spec.height) * size_t(channelCount(file.layout))))
            conversion.storeHalf();
        if (!texture) makeTexture();
        if (!conversion.isAsRead()) {
            std::atomic<size_t> bad{0};
            for (int level = 0; level < file.levels; ++level) {
                const MipLevel size = sizes[size_t(level)];
                const size_t to = size_t(size.width) * conversion.format().texelBytes();
                parallelFor(0, size.height, [&](int y) {
                    const size_t wrong = conversion.row(
                        target(level) + size_t(y) * size_t(size.width) * fileTexel,
                        static_cast<uint8_t*>(texture->levelData(level)) + size_t(y) * to,
                        size.width);
                    if (wrong) bad += wrong;
                });
            }
            if (bad)
                diagnostics.warn(source.prim, source.input,
                                 messages::texelsNotFinite(source.file, bad.load()));
        }
        buffer.reset();
        if (std::shared_ptr<ImageTexture> grey = texture->asGrey(file.levels))
            texture = std::move(grey);
        if (!source.finestOnly) texture->buildPyramid(file.levels);
    });
    return texture;
} catch (const std::bad_alloc&) {
    return unreadable(source, "there is not enough memory for it", diagnostics);
}

std::shared_ptr<ImageTexture> openTiledTexture(const ImageSource& source,
                                               const ColorSpaces& colorSpaces,
                                               const std::shared_ptr<TileStore>& store,
                                               Diagnostics& diagnostics) try {
    TextureFile file(source.file);
    if (!file.input) return unreadable(source, file.error, diagnostics);
    TexelConversion conversion(file.layout, texelTypeOf(file.spec),
                               transformOf(source, file, colorSpaces, diagnostics));
    if (isRadiance(file)) {
        std::string error;
        const bool small = fitsHalf(file, error);
        if (!error.empty()) return unreadable(source, error, diagnostics);
        if (small) conversion.storeHalf();
    }
    return std::make_shared<ImageTexture>(
        file.spec.width, file.spec.height, conversion.format(),
        std::make_unique<FileTiles>(source, file, conversion, store, diagnostics));
} catch (const std::bad_alloc&) {
    return unreadable(source, "there is not enough memory for it", diagnostics);
}

ImageRGB loadImageLinear(ImageSource source, Diagnostics& diagnostics) {
    ImageRGB result;
    std::shared_ptr<ImageTexture> texture;
    if (source.colorSpace.empty()) source.colorSpace = "auto";
    const std::string problem = tooLargeForALight(source.file);
    if (problem.empty())
        texture = loadImageTexture(source, ColorSpaces::shared(), diagnostics);
    else
        unreadable(source, problem, diagnostics);
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
