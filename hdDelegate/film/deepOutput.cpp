// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/deepOutput.h"

#include "hdDelegate/film/imageOutput.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/imagebufalgo.h>

#include <stdexcept>

namespace patina {

namespace {

const std::vector<std::string> deepChannels = {"R", "G", "B", "A", "Z", "ZBack"};

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot read '" + path + "': " + firstLine(reason));
}

} // namespace

void writeDeep(const DeepPixels& pixels, const std::string& path, const ImageOptions& options,
               const Metadata& metadata) {
    if (!isExr(path))
        throw std::runtime_error("cannot write '" + path + "': deep images are OpenEXR (.exr)");
    const ImagePlacement placement = placementOf(pixels.width(), pixels.height(), options);
    OIIO::ImageSpec spec =
        makeSpec(placement, int(deepChannels.size()), OIIO::TypeFloat, options, metadata);
    spec.channelnames = deepChannels;
    spec.alpha_channel = 3;
    spec.z_channel = 4;
    spec.deep = true;
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                   options.renderingSpace->chromaticities.data());
    spec.attribute("oiio:ColorSpace", "Linear");
    // What else there is does not hold deep scanlines.
    const std::string& packing = options.compression;
    spec.attribute("compression", packing == "none" || packing == "rle" ? packing : "zips");
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                   options.renderingSpace->chromaticities.data());
    OIIO::DeepData data(spec);
    const auto each = [&](const auto& visit) {
        for (int y = 0; y < placement.height; ++y)
            for (int x = 0; x < placement.width; ++x)
                visit(int64_t(y) * placement.width + x,
                      pixels.resolve(placement.sourceX + x, placement.sourceY + y));
    };
    each([&](int64_t pixel, const auto& samples) { data.set_samples(pixel, int(samples.size())); });
    each([&](int64_t pixel, const std::vector<DeepSample>& samples) {
        for (int s = 0; s < int(samples.size()); ++s) {
            const DeepSample& from = samples[size_t(s)];
            const float values[] = {from.color.r, from.color.g, from.color.b,
                                    from.alpha,   from.front,   from.back};
            for (int c = 0; c < int(deepChannels.size()); ++c)
                data.set_deep_value(pixel, c, s, values[c]);
        }
    });
    writeAtomically(path, spec,
                    [&](OIIO::ImageOutput& output) { return output.write_deep_image(data); });
}

DeepImage readDeep(const std::string& path) {
    auto input = OIIO::ImageInput::open(path);
    if (!input) fail(path, OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    OIIO::DeepData data;
    if (!spec.deep) fail(path, "it is no deep image");
    if (!input->read_native_deep_image(0, 0, data)) fail(path, input->geterror());
    DeepImage image;
    image.width = spec.width;
    image.height = spec.height;
    image.channels = spec.channelnames;
    for (int64_t pixel = 0; pixel < data.pixels(); ++pixel) {
        image.counts.push_back(data.samples(pixel));
        for (int s = 0; s < data.samples(pixel); ++s)
            for (int c = 0; c < spec.nchannels; ++c)
                image.values.push_back(data.deep_value(pixel, c, s));
    }
    return image;
}

std::vector<float> flattened(const std::string& path) {
    OIIO::ImageBuf deep(path);
    if (!deep.read(0, 0, true, OIIO::TypeFloat)) fail(path, deep.geterror());
    const OIIO::ImageBuf flat = OIIO::ImageBufAlgo::flatten(deep);
    if (flat.has_error()) fail(path, flat.geterror());
    const OIIO::ImageSpec& spec = flat.spec();
    std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
    if (!flat.get_pixels(flat.roi(), OIIO::TypeFloat, pixels.data())) fail(path, flat.geterror());
    return pixels;
}

} // namespace patina
