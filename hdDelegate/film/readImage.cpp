// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/deepOutput.h"
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/film/imageOutput.h"
#include "base/limits.h"
#include "base/regularFile.h"

#include <OpenImageIO/half.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <system_error>

namespace patina {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot read '" + path + "': " + firstLine(reason));
}

Metadata metadataOf(const OIIO::ImageSpec& spec) {
    Metadata metadata;
    for (const OIIO::ParamValue& p : spec.extra_attribs) {
        std::string name = p.name().string();
        if (p.type() == OIIO::TypeInt)
            metadata[name] = p.get_int();
        else if (p.type() == OIIO::TypeFloat)
            metadata[name] = double(p.get_float());
        else
            metadata[name] = p.get_string();
    }
    return metadata;
}

template <class T> T valueAt(const uint8_t* p) {
    T value;
    std::memcpy(&value, p, sizeof value);
    return value;
}

bool isRead(OIIO::TypeDesc type) {
    for (const auto& known : {OIIO::TypeHalf, OIIO::TypeUInt32, OIIO::TypeInt32, OIIO::TypeFloat,
                              OIIO::TypeUInt8, OIIO::TypeUInt16})
        if (type == known) return true;
    return false;
}

/// One value of a packed pixel as a number; OIIO would scale 32-bit integers as it scales colours.
float numberAt(const uint8_t* p, OIIO::TypeDesc type) {
    if (type == OIIO::TypeHalf) return float(valueAt<half>(p));
    if (type == OIIO::TypeUInt32 || type == OIIO::TypeInt32) return float(valueAt<int32_t>(p));
    if (type == OIIO::TypeUInt8) return float(*p) / 255.0f;
    if (type == OIIO::TypeUInt16) return float(valueAt<uint16_t>(p)) / 65535.0f;
    return valueAt<float>(p);
}

/// A file of a few bytes may name any size; one of many may hold large areas of one colour.
/// @throws std::runtime_error where the pixels would take more than that
void checkSize(const std::string& path, const OIIO::ImageSpec& spec) {
    constexpr uintmax_t packing = 4096;
    std::error_code problem;
    const uintmax_t bytes = std::filesystem::file_size(path, problem);
    const uint64_t most =
        std::max<uintmax_t>(limitOf(Limit::textureBytes),
                            problem ? 0 : std::min(bytes, UINTMAX_MAX / packing) * packing);
    const uint64_t pixel = uint64_t(spec.nchannels) * sizeof(float);
    if (uint64_t(spec.width) * uint64_t(spec.height) > most / pixel)
        fail(path, "its pixels take more bytes than " + limitText(Limit::textureBytes));
}

bool hasIntegers(const OIIO::ImageSpec& spec) {
    for (int c = 0; c < spec.nchannels; ++c)
        if (spec.channelformat(c) == OIIO::TypeUInt32 || spec.channelformat(c) == OIIO::TypeInt32)
            return true;
    return false;
}

} // namespace

ImageData readImage(const std::string& path) {
    const std::string problem = whyNoImage(path);
    if (!problem.empty()) fail(path, "it " + problem);
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) {
        std::string reason = OIIO::geterror();
        fail(path, reason.empty() ? "it is not an image" : reason);
    }
    const OIIO::ImageSpec spec = input->spec();
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1)
        fail(path, "it holds no flat image");
    checkSize(path, spec);
    ImageData image;
    image.width = spec.width;
    image.height = spec.height;
    image.x = spec.x - spec.full_x;
    image.y = spec.y - spec.full_y;
    image.displayWidth = spec.full_width;
    image.displayHeight = spec.full_height;
    image.pixelAspectRatio = spec.get_float_attribute("PixelAspectRatio", 1.0f);
    image.channels = spec.channelnames;
    image.metadata = metadataOf(spec);
    size_t n = size_t(spec.nchannels), count = size_t(spec.width) * size_t(spec.height);
    image.pixels.resize(count * n);
    if (spec.deep) {
        image.pixels = flattened(path);
        return image;
    }
    bool read;
    if (!hasIntegers(spec)) {
        read = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, image.pixels.data());
    } else {
        for (int c = 0; c < spec.nchannels; ++c)
            if (!isRead(spec.channelformat(c)))
                fail(path, "its channels have values of a kind that is not read");
        std::vector<uint8_t> packed(spec.image_bytes(true));
        read = input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, packed.data());
        const uint8_t* p = packed.data();
        for (size_t i = 0; read && i < count; ++i)
            for (size_t c = 0; c < n; ++c) {
                OIIO::TypeDesc type = spec.channelformat(int(c));
                image.pixels[i * n + c] = numberAt(p, type);
                p += type.size();
            }
    }
    if (!read || input->has_error()) fail(path, input->geterror());
    return image;
}

} // namespace patina
