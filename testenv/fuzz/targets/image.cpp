// SPDX-License-Identifier: Apache-2.0
// Any bytes as an image: its size, channels and metadata, as commands show them. The formats' own
// readers are OpenImageIO's.
#include "hdDelegate/film/imageFile.h"
#include "base/utf8.h"
#include "testenv/fuzz/targets/imageInput.h"
#include "testenv/fuzz/targets/targets.h"

#include <cstdlib>
#include <stdexcept>

bool fuzzImage(const uint8_t* data, size_t size) {
    using namespace patina;
    const std::string path = imageInput(data, size);
    if (path.empty()) return false;
    try {
        const ImageData image = readImage(path);
        if (image.pixels.size() !=
            size_t(image.width) * size_t(image.height) * image.channels.size())
            std::abort();
        for (const auto& entry : image.metadata)
            if (const std::string* text = std::get_if<std::string>(&entry.second)) {
                const std::string shown = validUtf8(*text);
                if (validUtf8(shown) != shown) std::abort(); // what is valid stays
            }
    } catch (const std::runtime_error& error) {
        if (std::string(error.what()).find('\n') != std::string::npos)
            std::abort(); // one line, always
        return false;
    }
    return true;
}
