// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageFile.h"

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/deepOutput.h"
#include "hdDelegate/film/imageOutput.h"
#include "hdDelegate/film/pixelSplat.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace patina {

namespace {

ChannelStore storeOf(const AovSpec& spec, const ImageOptions& options) {
    if (spec.isInteger) return options.integerIds ? ChannelStore::Int : ChannelStore::Float;
    const bool mayBeHalf = spec.id != AovId::unknown && aovRows()[size_t(spec.id)].mayBeHalf;
    return mayBeHalf && options.half ? ChannelStore::Half : ChannelStore::Float;
}

void checkOptions(const ImageOptions& options) {
    if (options.bits != 8 && options.bits != 16 && options.bits != 32)
        throw std::runtime_error("images have 8, 16 or 32 bits, not " +
                                 std::to_string(options.bits));
    if (!(options.pixelAspectRatio > 0.0))
        throw std::runtime_error("the pixel aspect ratio must be greater than 0");
}

void checkAovs(const std::string& path, const std::vector<std::string>& aovs) {
    if (isExr(path)) return;
    for (auto& name : aovs)
        if (name != "color" && name != "alpha")
            throw std::runtime_error("cannot write '" + path +
                                     "': only OpenEXR (.exr) holds AOV '" + name + "'");
}

} // namespace

std::vector<std::string> channelNames(const AovSpec& spec) {
    if (spec.kind == AovKind::Coverage) return cryptomatteChannels(spec);
    const AovRow row = spec.id == AovId::unknown ? AovRow() : aovRows()[size_t(spec.id)];
    std::string letters = row.letters;
    const std::string name = channelsOfAov(spec.name);
    if (letters.empty() && spec.components == 1) return {name};
    if (letters.empty() && spec.components <= 4) letters = "XYZW";
    std::vector<std::string> names;
    for (size_t i = 0; i < size_t(spec.components); ++i) {
        const std::string part = letters.empty() ? std::to_string(i) : std::string(1, letters[i]);
        // The colour before denoising has the row of the colour and another name.
        names.push_back(row.isBare && spec.name == row.name ? part : name + "." + part);
    }
    return names;
}

void checkImagePath(const std::string& path, const std::vector<std::string>& aovs) {
    createOutput(path);
    checkAovs(path, aovs);
    std::map<std::string, std::string> known;
    for (auto& name : aovs) {
        try {
            standardAov(name);
        } catch (const std::invalid_argument& e) {
            throw std::runtime_error(e.what());
        }
        const auto [other, isNew] = known.emplace(channelsOfAov(name), name);
        if (!isNew && other->second != name)
            throw std::runtime_error("AOVs '" + other->second + "' and '" + name +
                                     "' would both be written as '" + other->first +
                                     "': name them NAME=lpe:EXPRESSION");
    }
    AtomicFile probe(path);
}

/// Whether eyes are what it is for: nobody measures values after a display transform.
static bool isShown(const std::string& path, const ImageOptions& options) {
    const size_t dot = path.rfind('.');
    std::string extension = dot == std::string::npos ? "" : path.substr(dot + 1);
    for (char& c : extension)
        c = char(std::tolower(static_cast<unsigned char>(c)));
    return !options.raw && options.bits != 32 && extension != "hdr";
}

void writeImage(const Film& film, const std::string& path, const ImageOptions& options,
                const Metadata& metadata) {
    checkOptions(options);
    if (options.deep) {
        if (!film.deep())
            throw std::runtime_error("cannot write '" + path + "': no deep pixels were kept");
        return writeDeep(*film.deep(), path, options, metadata);
    }
    checkAovs(path, options.aovs);
    ImagePlacement placement = placementOf(film.width(), film.height(), options);
    std::vector<std::string> names = options.aovs;
    if (names.empty()) {
        names = {"color", "alpha"};
        for (auto& spec : film.aovs())
            if (spec.name != "color" && spec.name != "alpha" && !isOfQuarters(spec.id))
                names.push_back(spec.name);
    }
    if (isExr(path)) {
        std::vector<std::vector<float>> resolved;
        std::vector<ChannelSource> channels;
        Metadata told = metadata;
        for (auto& name : names) {
            AovSpec spec;
            if (!film.findSpec(name, spec))
                throw std::runtime_error("the film holds no AOV '" + name + "'");
            if (spec.kind == AovKind::Coverage) {
                checkCryptomatteCompression(path, options.compression);
                addCryptomatteMetadata(spec, film.coverageNames(name), told);
            }
            resolved.push_back(film.resolve(name));
            std::vector<std::string> parts = channelNames(spec);
            for (size_t c = 0; c < parts.size(); ++c)
                channels.push_back({parts[c], storeOf(spec, options), resolved.back().data() + c,
                                    parts.size(), spec.isInteger});
        }
        writeExr(channels, film.width(), placement, path, options, told);
        return;
    }
    bool alpha = std::find(names.begin(), names.end(), "alpha") != names.end();
    std::vector<float> color = film.resolve("color"), coverage = film.resolve("alpha");
    if (std::find(names.begin(), names.end(), "color") == names.end()) {
        writeDisplayImage(coverage.data(), 1, film.width(), placement, path, options, metadata);
        return;
    }
    if (options.outliers == Outliers::Spread && isShown(path, options) && !film.denoised()) {
        if (film.splats()) { // an outlier is one of the pixels, not of those that it counts for
            for (size_t i = 0; i < color.size() / 3; ++i) {
                const glm::vec3 own = film.color(int(i) % film.width(), int(i) / film.width());
                std::copy(&own.x, &own.x + 3, &color[3 * i]);
            }
            spreadOutliers(film, color);
            color = PixelSplat(film).color(color);
        } else {
            spreadOutliers(film, color);
        }
    }
    std::vector<float> pixels(coverage.size() * 4);
    for (size_t i = 0; i < coverage.size(); ++i) {
        std::copy(&color[i * 3], &color[i * 3] + 3, &pixels[i * 4]);
        pixels[i * 4 + 3] = std::min(coverage[i], 1.0f);
    }
    if (alpha)
        writeDisplayImage(pixels.data(), 4, film.width(), placement, path, options, metadata);
    else
        writeDisplayImage(color.data(), 3, film.width(), placement, path, options, metadata);
}

void writePixels(const ImageData& image, const std::string& path, const ImageOptions& options) {
    checkOptions(options);
    size_t n = image.channels.size();
    if (n < 1 || image.pixels.size() != n * size_t(image.width) * size_t(image.height))
        throw std::runtime_error("the pixels do not have the size that the image names");
    ImagePlacement placement = placementOf(image.width, image.height, options);
    if (isExr(path)) {
        std::vector<ChannelSource> channels;
        for (size_t c = 0; c < n; ++c)
            channels.push_back({image.channels[c],
                                options.half ? ChannelStore::Half : ChannelStore::Float,
                                image.pixels.data() + c, n});
        writeExr(channels, image.width, placement, path, options, image.metadata);
        return;
    }
    size_t kept = n >= 4 ? 4 : n == 3 ? 3 : 1;
    std::vector<float> pixels(kept * size_t(image.width) * size_t(image.height));
    for (size_t i = 0; i < pixels.size() / kept; ++i)
        std::copy(&image.pixels[i * n], &image.pixels[i * n] + kept, &pixels[i * kept]);
    writeDisplayImage(pixels.data(), int(kept), image.width, placement, path, options,
                      image.metadata);
}

} // namespace patina
