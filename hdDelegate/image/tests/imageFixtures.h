// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/tests/testTools.h"
#include "hdDelegate/film/tests/tempFolder.h"
#include "hdDelegate/image/textureSystem.h"

#include <OpenImageIO/imageio.h>

#include <cmath>

namespace patina {

const glm::vec4 magenta(1, 0, 1, 1);

inline float srgb(float v) {
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

inline OIIO::ImageSpec specOf(int width, int height, int channels, OIIO::TypeDesc type) {
    OIIO::ImageSpec spec(width, height, channels, type);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("CompressionQuality", 100);
    return spec;
}

inline void writeImage(const std::string& file, const OIIO::ImageSpec& spec,
                       const std::vector<float>& values) {
    auto out = OIIO::ImageOutput::create(file);
    ASSERT_TRUE(out && out->open(file, spec)) << file << OIIO::geterror();
    ASSERT_TRUE(out->write_image(OIIO::TypeFloat, values.data())) << out->geterror();
    ASSERT_TRUE(out->close());
}

using Tag = std::function<void(OIIO::ImageSpec&)>;

/// The same channels in all pixels.
inline void writeConstant(const std::string& file, int width, int height,
                          const std::vector<float>& channels, OIIO::TypeDesc type,
                          const Tag& tag = {}) {
    OIIO::ImageSpec spec = specOf(width, height, int(channels.size()), type);
    if (tag) tag(spec);
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i)
        values.insert(values.end(), channels.begin(), channels.end());
    writeImage(file, spec, values);
}

inline TextureRequest requestOf(const std::string& file, const std::string& colorSpace = "auto") {
    TextureRequest request;
    request.file = file;
    request.colorSpace = colorSpace;
    request.prim = "/Material/texture";
    request.input = "inputs:file";
    return request;
}

class TextureTest : public ::testing::Test {
protected:
    TempFolder temp;
    Diagnostics diagnostics;
    TextureSystem textures{diagnostics};

    int open(const std::string& file, const std::string& colorSpace = "auto") {
        return textures.open(requestOf(file, colorSpace));
    }
    glm::vec4 middle(int handle) { return textures.sample(handle, {0.5f, 0.5f}, 0.0f); }
};

} // namespace patina
