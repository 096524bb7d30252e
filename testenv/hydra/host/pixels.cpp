// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/host/pixels.h"

#include <pxr/base/gf/half.h>

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

float valueOf(const uint8_t* bytes, HdFormat component) {
    switch (component) {
    case HdFormatUNorm8: return float(*bytes) / 255.0f;
    case HdFormatFloat16: {
        GfHalf half;
        std::memcpy(&half, bytes, sizeof(half));
        return float(half);
    }
    case HdFormatFloat32: {
        float value;
        std::memcpy(&value, bytes, sizeof(value));
        return value;
    }
    case HdFormatInt32: {
        int32_t value;
        std::memcpy(&value, bytes, sizeof(value));
        return float(value);
    }
    default: throw std::runtime_error("a render buffer has a format that the host does not read");
    }
}

std::vector<std::string> channelsOf(const HostLayer& layer) {
    const int count = layer.image.components;
    if (layer.aov == "color" && count == 4) return {"R", "G", "B", "A"};
    if (count == 1) return {layer.aov};
    std::vector<std::string> names;
    for (int i = 0; i < count; ++i)
        names.push_back(layer.aov + "." + std::string(1, "xyzw"[i]));
    return names;
}

} // namespace

HostImage readBuffer(HdRenderBuffer& buffer) {
    HostImage image;
    image.width = int(buffer.GetWidth());
    image.height = int(buffer.GetHeight());
    const HdFormat format = buffer.GetFormat();
    image.components = int(HdGetComponentCount(format));
    if (image.width * image.height == 0) return image;
    buffer.Resolve();
    const auto* bytes = static_cast<const uint8_t*>(buffer.Map());
    if (!bytes) throw std::runtime_error("a render buffer cannot be mapped");
    const HdFormat component = HdGetComponentFormat(format);
    const size_t step = HdDataSizeOfFormat(component);
    const size_t rowValues = size_t(image.width) * size_t(image.components);
    image.values.resize(rowValues * size_t(image.height));
    for (int y = 0; y < image.height; ++y) // Hydra's row 0 is the bottom row
        for (size_t i = 0; i < rowValues; ++i)
            image.values[size_t(image.height - 1 - y) * rowValues + i] =
                valueOf(bytes + (size_t(y) * rowValues + i) * step, component);
    buffer.Unmap();
    return image;
}

HdFormat formatOf(const std::string& name) {
    struct Base {
        const char* name;
        HdFormat first;
    };
    const Base bases[] = {{"unorm8", HdFormatUNorm8},
                          {"float16", HdFormatFloat16},
                          {"float32", HdFormatFloat32},
                          {"int32", HdFormatInt32}};
    for (const Base& base : bases) {
        const std::string stem = base.name;
        if (name == stem) return base.first;
        for (int count = 2; count <= 4; ++count)
            if (name == stem + "vec" + std::to_string(count))
                return HdFormat(int(base.first) + count - 1);
    }
    throw std::runtime_error("there is no buffer format " + name);
}

void writeExr(const std::string& path, const std::vector<HostLayer>& layers) {
    if (layers.empty() || layers.front().image.values.empty())
        throw std::runtime_error(path + ": there is nothing to write");
    const int width = layers.front().image.width, height = layers.front().image.height;
    std::vector<std::string> names;
    for (const HostLayer& layer : layers)
        for (const std::string& name : channelsOf(layer))
            names.push_back(name);
    std::vector<float> values;
    values.reserve(size_t(width) * size_t(height) * names.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (const HostLayer& layer : layers) {
                const float* pixel = layer.image.pixel(x, y);
                values.insert(values.end(), pixel, pixel + layer.image.components);
            }
    OIIO::ImageSpec spec(width, height, int(names.size()), OIIO::TypeDesc::FLOAT);
    spec.channelnames = names;
    spec.attribute("compression", "zip");
    auto out = OIIO::ImageOutput::create(path);
    if (!out || !out->open(path, spec) || !out->write_image(OIIO::TypeDesc::FLOAT, values.data()) ||
        !out->close())
        throw std::runtime_error(
            path + ": cannot be written: " + (out ? out->geterror() : OIIO::geterror()));
}

} // namespace patina
