// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightImages.h"

#include "hdDelegate/lights/networkImage.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// All that a network's image follows from.
std::string textOf(const Network& network) {
    std::string text;
    const auto add = [&](const std::string& part) { text += part + '\n'; };
    const auto addLinks = [&](const std::map<std::string, Connection>& links) {
        for (const auto& [name, link] : links)
            add(name), add(link.node), add(link.output);
    };
    addLinks(network.terminals);
    for (const NetworkNode& node : network.nodes) {
        add(node.path), add(node.id);
        addLinks(node.connections);
        for (const auto& [name, value] : node.inputs) {
            add(name), add(value.text), add(value.colorSpace);
            for (const float number : value.numbers)
                text.append(reinterpret_cast<const char*>(&number), sizeof number);
        }
    }
    return text;
}

} // namespace

LightImages::LightImages(Diagnostics& diagnostics)
    : _loader([&diagnostics, this](const std::string& file, const std::string& colorSpace,
                                   const std::string& prim, const std::string& input) {
          return loadImageLinear({file, colorSpace, prim, input, false, _renderingSpace},
                                 diagnostics);
      }),
      _diagnostics(&diagnostics) {}

LightImages::Image LightImages::image(const std::string& file, const std::string& colorSpace,
                                      const std::string& prim, const std::string& input) {
    const std::string key = _renderingSpace.load()->name + '\n' + colorSpace + '\n' + file;
    return kept(key, [&] { return _loader(file, colorSpace, prim, input); });
}

LightImages::Image LightImages::image(const Light& light) {
    const Image file = light.textureFile.empty() ? nullptr
                                                 : image(light.textureFile, light.textureColorSpace,
                                                         light.path, "inputs:texture:file");
    if (light.network.empty() || (file && !file->valid)) return file;
    return kept(keyOf(light), [&] {
        Diagnostics untold;
        return networkImage(light, file.get(), *_renderingSpace.load(),
                            _diagnostics ? *_diagnostics : untold);
    });
}

std::string LightImages::keyOf(const Light& light) const {
    std::string key = light.textureColorSpace + '\n' + light.textureFile;
    if (!light.network.empty())
        key += '\n' + std::to_string(int(light.type)) + ' ' + std::to_string(light.width) + ' ' +
               std::to_string(light.height) + '\n' + textOf(light.network);
    return _renderingSpace.load()->name + '\n' + key;
}

LightImages::Image LightImages::kept(const std::string& key,
                                     const std::function<ImageRGB()>& make) {
    std::lock_guard<std::mutex> lock(_mutex);
    Image& entry = _images[key];
    if (entry) return entry;
    auto image = std::make_shared<ImageRGB>(make());
    const bool usable = image->width > 0 && image->height > 0 &&
                        image->pixels.size() >= size_t(image->width) * size_t(image->height);
    if (!usable) {
        image->width = image->height = 1;
        image->pixels.assign(1, vec3(1.0f, 0.0f, 1.0f));
        image->valid = false;
    }
    // A single broken pixel must not spoil the sums that sampling is built from.
    for (vec3& pixel : image->pixels)
        for (int c = 0; c < 3; ++c)
            pixel[c] =
                pixel[c] > 0.0f && std::isfinite(pixel[c]) ? std::min(pixel[c], 1e30f) : 0.0f;
    if (!image->valid) {
        // Not kept: the file may be there the next time.
        std::shared_ptr<const ImageRGB> result = std::move(image);
        _images.erase(key);
        return result;
    }
    entry = std::move(image);
    return entry;
}

std::shared_ptr<const EnvironmentMap> LightImages::environment(const Light& dome) {
    // What a network paints alone is a latlong map.
    const EnvironmentFormat format = dome.textureFile.empty()
                                         ? EnvironmentFormat::Latlong
                                         : environmentFormat(dome.textureFormat);
    const std::string key = std::to_string(int(format)) + '\n' + keyOf(dome);
    const std::lock_guard<std::mutex> building(_building);
    {
        std::lock_guard<std::mutex> lock(_mutex);
        const auto found = _environments.find(key);
        if (found != _environments.end()) return found->second;
    }
    const Image source = image(dome);
    auto map = std::make_shared<const EnvironmentMap>(source, format);
    if (source->valid) {
        std::lock_guard<std::mutex> lock(_mutex);
        _environments[key] = map;
    }
    return map;
}

void LightImages::forgetUnused() {
    const std::lock_guard<std::mutex> building(_building);
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto forget = [](auto& known) {
        for (auto it = known.begin(); it != known.end();)
            it = it->second.use_count() > 1 ? std::next(it) : known.erase(it);
    };
    forget(_environments); // which use images
    forget(_images);
}

} // namespace patina
