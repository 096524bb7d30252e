// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/image/fileColorSpace.h"

#include "hdDelegate/image/iccProfile.h"
#include "materialNetwork/color/colorSpaces.h"

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

namespace patina {

namespace {

constexpr const char* srgb = "srgb_texture";

uint32_t bigEndian(const uint8_t* at) {
    return uint32_t(at[0]) << 24 | uint32_t(at[1]) << 16 | uint32_t(at[2]) << 8 | at[3];
}

/// OpenImageIO says sRGB of every PNG, tagged or not: so its chunks are looked at here.
std::string spaceOfPng(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::array<uint8_t, 8> head;
    std::array<uint8_t, 32> data;
    const auto read = [&](uint8_t* to, size_t count) {
        return bool(in.read(reinterpret_cast<char*>(to), std::streamsize(count)));
    };
    double encoding = 0.0;
    Primaries primaries;
    bool hasPrimaries = false;
    if (!read(head.data(), 8)) return {}; // the signature
    constexpr int mostChunks = 1000;
    for (int chunk = 0; chunk < mostChunks && read(head.data(), 8); ++chunk) {
        const uint32_t size = bigEndian(head.data());
        const auto is = [&](const char* name) { return std::memcmp(&head[4], name, 4) == 0; };
        if (is("IDAT")) break;
        if (is("sRGB")) return srgb;
        const bool known = (is("gAMA") && size == 4) || (is("cHRM") && size == 32);
        if (known && !read(data.data(), size)) break;
        if (known && size == 4) encoding = bigEndian(data.data()) / 1e5;
        if (known && size == 32) {
            double* const to[] = {primaries.white, primaries.red, primaries.green, primaries.blue};
            for (size_t i = 0; i < 8; ++i)
                to[i / 2][i % 2] = bigEndian(&data[4 * i]) / 1e5;
            hasPrimaries = true;
        }
        in.seekg(std::streamoff(known ? 0 : size) + 4, std::ios::cur); // the checksum
    }
    if (!(encoding > 0.1 && encoding <= 10.0)) return {};
    // 1/2.2 is how sRGB is written as an exponent.
    const bool likeSrgb = std::abs(encoding - 0.45455) < 5e-3;
    return spaceOf(hasPrimaries ? &primaries : nullptr,
                   likeSrgb ? CurveShape{2.4, 0.055} : CurveShape{1.0 / encoding, 0.0});
}

std::string spaceOfExr(const OIIO::ImageSpec& spec) {
    const OIIO::ParamValue* found = spec.find_attribute("chromaticities");
    if (!found || found->type().basetype != OIIO::TypeDesc::FLOAT ||
        found->type().basevalues() * size_t(found->nvalues()) != 8)
        return {};
    Primaries primaries;
    double* const to[] = {primaries.red, primaries.green, primaries.blue, primaries.white};
    for (size_t i = 0; i < 8; ++i)
        to[i / 2][i % 2] = double(static_cast<const float*>(found->data())[i]);
    return spaceOf(&primaries, CurveShape());
}

std::string spaceOfProfile(const OIIO::ImageSpec& spec, bool& unread) {
    const OIIO::ParamValue* found = spec.find_attribute("ICCProfile");
    if (!found || found->type().basetype != OIIO::TypeDesc::UINT8) return {};
    const auto* bytes = static_cast<const uint8_t*>(found->data());
    const size_t size = size_t(found->datasize());
    const std::string space = spaceOfIccProfile(bytes, size);
    // Inks were made colours when the file was read.
    unread = space.empty() && (size < 20 || std::memcmp(bytes + 16, "CMYK", 4) != 0);
    return space;
}

} // namespace

std::string automaticSpace(const std::string& file, const std::string& format,
                           const OIIO::ImageSpec& spec, const ColorSpaces& colorSpaces,
                           bool& unread) {
    const auto usable = [&](const std::string& space) {
        return !space.empty() && colorSpaces.toRec709(space);
    };
    unread = false;
    std::string space = spaceOfProfile(spec, unread);
    if (!usable(space) && format == "png") space = spaceOfPng(file);
    if (!usable(space) && format == "openexr") space = spaceOfExr(spec);
    if (!usable(space) && spec.get_int_attribute("Exif:ColorSpace") == 1) space = srgb;
    if (usable(space)) {
        unread = false;
        return space;
    }
    const bool linear =
        OIIO::Strutil::iequals(spec.get_string_attribute("oiio:ColorSpace"), "linear") ||
        spec.get_float_attribute("oiio:Gamma", 0.0f) == 1.0f;
    const bool eightBitColor = spec.format == OIIO::TypeUInt8 && spec.nchannels >= 3;
    return eightBitColor && !linear ? srgb : "raw";
}

} // namespace patina
