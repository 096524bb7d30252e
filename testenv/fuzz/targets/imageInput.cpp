// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/imageInput.h"

#include "testenv/fuzz/targets/inputLimits.h"
#include "testenv/fuzz/targets/scratchFiles.h"

#include <OpenImageIO/imageio.h>

#include <cstdlib>
#include <cstring>

namespace patina {

namespace {

struct Format {
    const char* begin; ///< no zeros, but behind it
    const char* extension;
};

constexpr Format formats[] = {
    {"\x89PNG", "png"}, {"\x76\x2f\x31\x01", "exr"}, {"#?", "hdr"},          {"II\x2a", "tif"},
    {"MM", "tif"},      {"II\x2b", "tif"},           {"\xff\xd8\xff", "jpg"}};

const char* extensionOf(const uint8_t* data, size_t size) {
    for (const Format& format : formats) {
        const size_t length = std::strlen(format.begin);
        if (size > length && std::memcmp(data, format.begin, length) == 0) return format.extension;
    }
    return nullptr;
}

} // namespace

std::string imageInput(const uint8_t* data, size_t size) {
    static const bool quick = OIIO::attribute("threads", 1) && OIIO::attribute("exr_threads", -1) &&
                              OIIO::attribute("try_all_readers", 0);
    if (!quick) std::abort();
    limitInputs();
    static const ScratchFiles files;
    const char* extension = extensionOf(data, size);
    return extension ? files.write(std::string("input.") + extension, data, size) : std::string();
}

} // namespace patina
