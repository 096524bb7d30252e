// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/textureFile.h"

#include "base/regularFile.h"

#include <algorithm>

namespace patina {

namespace {

TexelLayout layoutOf(const OIIO::ImageSpec& s) {
    if (s.nchannels == 1) return TexelLayout::Grey;
    if (s.nchannels == 2) {
        bool redGreen = s.channelnames.size() > 1 && s.channelnames[1] == "G";
        return redGreen ? TexelLayout::RedGreen : TexelLayout::GreyAlpha;
    }
    bool alpha = s.nchannels > 3 && (s.alpha_channel == 3 || s.nchannels == 4);
    return alpha ? TexelLayout::Rgba : TexelLayout::Rgb;
}

/// @returns where the levels begin that are used
std::vector<std::array<int, 2>> ownLevels(OIIO::ImageInput& input, const OIIO::ImageSpec& first) {
    std::vector<std::array<int, 2>> origins = {{first.x, first.y}};
    const std::vector<MipLevel> sizes = mipLevels(first.width, first.height);
    while (origins.size() < sizes.size() && input.seek_subimage(0, int(origins.size()))) {
        const OIIO::ImageSpec& s = input.spec();
        const MipLevel& size = sizes[origins.size()];
        if (s.width != size.width || s.height != size.height || s.depth > 1 ||
            s.nchannels != first.nchannels || s.format != first.format)
            break;
        origins.push_back({s.x, s.y});
    }
    input.seek_subimage(0, 0);
    input.geterror(); // of the level that is not there
    return origins;
}

} // namespace

std::string oneLine(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    while (!text.empty() && text.back() == ' ')
        text.pop_back();
    return text;
}

TexelType texelTypeOf(const OIIO::ImageSpec& spec) {
    switch (spec.format.basetype) {
    case OIIO::TypeDesc::UINT8: return TexelType::U8;
    case OIIO::TypeDesc::UINT16: return TexelType::U16;
    case OIIO::TypeDesc::HALF: return TexelType::Half;
    default: return TexelType::Float;
    }
}

OIIO::TypeDesc typeOf(TexelType type) {
    static const OIIO::TypeDesc types[] = {OIIO::TypeUInt8, OIIO::TypeUInt16, OIIO::TypeHalf,
                                           OIIO::TypeFloat};
    return types[int(type)];
}

TextureFile::TextureFile(const std::string& file) {
    const std::string problem = whyNoImage(file);
    if (!problem.empty()) {
        error = "the file " + problem;
        return;
    }
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1); // texels as stored: premultiplying loses colour
    input = OIIO::ImageInput::open(file, &hints);
    if (!input) {
        error = oneLine(OIIO::geterror());
        if (error.empty()) error = "it cannot be read";
        return;
    }
    spec = input->spec();
    constexpr int longest = 1 << 28; // twice a side, and one more, are numbers of 32 bits
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 ||
        spec.width > longest || spec.height > longest) {
        error = "an image of " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                "x" + std::to_string(spec.depth) + " is not a texture";
        input.reset();
        return;
    }
    layout = layoutOf(spec);
    origins = ownLevels(*input, spec);
    levels = int(origins.size());
}

uint64_t TextureFile::bytes() const {
    const double texels = 4.0 / 3.0 * spec.width * double(spec.height);
    const size_t each = TexelFormat(layout, texelTypeOf(spec)).texelBytes();
    return uint64_t(std::min(texels * double(each), 1e18)) + 1;
}

} // namespace patina
