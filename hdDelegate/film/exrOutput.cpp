// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageOutput.h"
#include "hdDelegate/film/temporaryFailure.h"
#include "hdDelegate/parallel.h"

#include <OpenEXR/IexBaseExc.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenImageIO/half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

constexpr float largestHalf = 65504.0f;

size_t bytesOf(ChannelStore store) {
    return store == ChannelStore::Half ? 2 : 4;
}

OIIO::TypeDesc typeOf(ChannelStore store) {
    if (store == ChannelStore::Half) return OIIO::TypeHalf;
    return store == ChannelStore::Int ? OIIO::TypeUInt32 : OIIO::TypeFloat;
}

int32_t intOf(float bits) {
    int32_t value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

void put(const ChannelSource& channel, const float* from, uint8_t* to) {
    if (channel.store == ChannelStore::Int) {
        int32_t id = channel.bits ? intOf(*from) : int32_t(std::lround(*from));
        std::memcpy(to, &id, sizeof id);
        return;
    }
    float value = channel.bits ? float(intOf(*from)) : *from;
    if (channel.store == ChannelStore::Half) {
        half h(std::min(std::max(value, -largestHalf), largestHalf));
        std::memcpy(to, &h, sizeof h);
    } else {
        std::memcpy(to, &value, sizeof value);
    }
}

} // namespace

void checkExrIsWhole(const std::string& path, const std::string& file) {
    bool whole = false;
    try {
        whole = Imf::MultiPartInputFile(file.c_str(), 0).partComplete(0);
    } catch (const Iex::BaseExc& error) {
        throw std::runtime_error("cannot write '" + path +
                                 "': what was written cannot be read: " + firstLine(error.what()));
    }
    if (!whole)
        throw TemporaryFailure("cannot write '" + path +
                               "': OpenEXR left rows out, as it does where memory runs out");
}

void writeExr(const std::vector<ChannelSource>& channels, int sourceWidth,
              const ImagePlacement& placement, const std::string& path, const ImageOptions& options,
              const Metadata& metadata) {
    OIIO::ImageSpec spec =
        makeSpec(placement, int(channels.size()), OIIO::TypeFloat, options, metadata);
    spec.channelnames.clear();
    std::vector<size_t> offsets;
    size_t pixelBytes = 0;
    for (size_t i = 0; i < channels.size(); ++i) {
        spec.channelnames.push_back(channels[i].name);
        spec.channelformats.push_back(typeOf(channels[i].store));
        offsets.push_back(pixelBytes);
        pixelBytes += bytesOf(channels[i].store);
    }
    spec.alpha_channel = spec.channelindex("A");
    spec.attribute("compression", options.compression);
    constexpr OIIO::TypeDesc eightFloats(OIIO::TypeDesc::FLOAT, 8);
    const auto read = metadata.find("chromaticities"); // of the file that the pixels came from
    if (read != metadata.end())
        spec.attribute("chromaticities", eightFloats, std::get<std::string>(read->second));
    else
        spec.attribute("chromaticities", eightFloats,
                       options.renderingSpace->chromaticities.data());
    spec.attribute("oiio:ColorSpace", "Linear");

    writeAtomically(path, spec, [&](OIIO::ImageOutput& output) {
        constexpr int strip = 64; // rows; a multiple of every compression's block
        std::vector<uint8_t> packed(pixelBytes * size_t(placement.width) * strip);
        for (int top = 0; top < placement.height; top += strip) {
            int rows = std::min(strip, placement.height - top);
            parallelFor(0, rows, [&](int row) {
                size_t source = size_t(placement.sourceY + top + row) * size_t(sourceWidth) +
                                size_t(placement.sourceX);
                uint8_t* to = &packed[size_t(row) * size_t(placement.width) * pixelBytes];
                for (int x = 0; x < placement.width; ++x, to += pixelBytes)
                    for (size_t c = 0; c < channels.size(); ++c)
                        put(channels[c],
                            channels[c].data + (source + size_t(x)) * channels[c].stride,
                            to + offsets[c]);
            });
            // Native format: OIIO would scale ids as it scales integer colours.
            if (!output.write_scanlines(placement.y + top, placement.y + top + rows, 0,
                                        OIIO::TypeDesc::UNKNOWN, packed.data()))
                return false;
        }
        return true;
    });
}

} // namespace patina
