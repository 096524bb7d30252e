// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageOutput.h"

#include "hdDelegate/film/atomicFile.h"
#include "hdDelegate/film/temporaryFailure.h"
#include "hdDelegate/film/watchedFile.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace patina {

namespace {

std::string extensionOf(const std::string& path) {
    std::string e = std::filesystem::path(path).extension().string();
    std::transform(e.begin(), e.end(), e.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return e;
}

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
    throw std::runtime_error("cannot write '" + path + "': " + firstLine(reason));
}

/// Not every writer tells when a disk is full.
void readBack(const std::string& path, const std::string& temporary) {
    auto input = OIIO::ImageInput::open(temporary);
    if (!input) fail(path, "what was written cannot be read: " + OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * size_t(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
        fail(path, "what was written cannot be read: " + input->geterror());
}

} // namespace

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

bool isExr(const std::string& path) {
    return extensionOf(path) == ".exr";
}

ImagePlacement placementOf(int width, int height, const ImageOptions& options) {
    if (width < 1 || height < 1)
        throw std::runtime_error("an image of " + std::to_string(width) + "x" +
                                 std::to_string(height) + " pixels cannot be written");
    const int* window = options.dataWindow;
    ImagePlacement p = {width, height, 0, 0, 0, 0, width, height};
    if (options.displayWidth > 0) p.displayWidth = options.displayWidth;
    if (options.displayHeight > 0) p.displayHeight = options.displayHeight;
    if (window[2] < window[0] || window[3] < window[1]) return p;

    int64_t windowWidth = int64_t(window[2]) - window[0] + 1;
    int64_t windowHeight = int64_t(window[3]) - window[1] + 1;
    if (width == windowWidth && height == windowHeight) {
        p.x = window[0];
        p.y = window[1];
        return p;
    }
    if (width != p.displayWidth || height != p.displayHeight)
        throw std::runtime_error("the film has " + std::to_string(width) + "x" +
                                 std::to_string(height) +
                                 " pixels, which is neither the image nor its data window");
    int right = std::min(window[2], width - 1), bottom = std::min(window[3], height - 1);
    p.x = p.sourceX = std::max(window[0], 0);
    p.y = p.sourceY = std::max(window[1], 0);
    p.width = right - p.x + 1;
    p.height = bottom - p.y + 1;
    if (p.width < 1 || p.height < 1)
        throw std::runtime_error("the data window lies outside of the image");
    return p;
}

std::unique_ptr<OIIO::ImageOutput> createOutput(const std::string& path) {
    std::string extension = extensionOf(path);
    if (extension.empty()) fail(path, "its name has no extension that says which format it is");
    // "term" would print on the terminal and "null" writes nothing.
    bool pretends = extension == ".term" || extension == ".null" || extension == ".nul";
    auto output = pretends ? nullptr : OIIO::ImageOutput::create(path);
    if (!output) {
        (void)OIIO::geterror();
        fail(path, "'" + extension + "' is not the extension of a format that can be written");
    }
    return output;
}

OIIO::ImageSpec makeSpec(const ImagePlacement& placement, int channels, OIIO::TypeDesc type,
                         const ImageOptions& options, const Metadata& metadata) {
    OIIO::ImageSpec spec(placement.width, placement.height, channels, type);
    spec.x = placement.x;
    spec.y = placement.y;
    spec.full_width = placement.displayWidth;
    spec.full_height = placement.displayHeight;
    spec.attribute("PixelAspectRatio", float(options.pixelAspectRatio));
    spec.attribute("Software", "Patina");
    for (auto& [name, value] : metadata) {
        if (auto text = std::get_if<std::string>(&value))
            spec.attribute(name, *text);
        else if (auto number = std::get_if<int>(&value))
            spec.attribute(name, *number);
        else
            spec.attribute(name, float(std::get<double>(value)));
    }
    return spec;
}

void writeAtomically(const std::string& path, const OIIO::ImageSpec& spec,
                     const std::function<bool(OIIO::ImageOutput&)>& write) {
    auto output = createOutput(path);
    AtomicFile file(path);
    std::unique_ptr<WatchedFile> watched;
    // OIIO 2.4 says that TIFF can, but leaves its directory out.
    if (output->supports("ioproxy") && output->format_name() != std::string("tiff")) {
        watched = std::make_unique<WatchedFile>(file.temporaryPath());
        output->set_ioproxy(watched.get());
    }
    bool good = output->open(file.temporaryPath(), spec);
    std::string reason = good ? std::string() : output->geterror();
    if (good && !write(*output)) good = false;
    if (reason.empty()) reason = output->geterror();
    if (!output->close()) good = false;
    if (reason.empty()) reason = output->geterror();
    if (const int problem = watched ? watched->finish() : 0)
        failWith("cannot write '" + path + "'", problem);
    if (!good) fail(path, reason);
    if (!watched) readBack(path, file.temporaryPath());
    if (isExr(path)) checkExrIsWhole(path, file.temporaryPath());
    file.commit();
}

} // namespace patina
