// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/distortionMap.h"

#include "hdDelegate/image/imageTextureLoad.h"

#include <algorithm>
#include <cmath>

namespace patina {

DistortionMap::DistortionMap(int width, int height, const std::vector<vec2>& places)
    : _width(width), _height(height), _ways(places.size()) {
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const size_t i = size_t(y) * size_t(width) + size_t(x);
            const float u = float((x + 0.5) / width), v = float((height - y - 0.5) / height);
            _ways[i] = vec2(places[i].x - u, v - places[i].y);
        }
}

std::shared_ptr<const DistortionMap> DistortionMap::read(const Camera& camera,
                                                         Diagnostics& diagnostics) {
    const std::string& file = camera.lens.distortionMap;
    const char* const input = "patina:distortionMap";
    if (file.empty()) return nullptr;
    const ImageHeader header = probeImage(file);
    const TexelLayout layout = header.layout;
    std::string problem = header.problem.empty() ? header.tooLarge : header.problem;
    if (problem.empty() && (layout == TexelLayout::Grey || layout == TexelLayout::GreyAlpha))
        problem = "it has no green channel";
    if (!problem.empty()) {
        diagnostics.warn(camera.path, input, messages::distortionMapUnusable(file, problem));
        return nullptr;
    }
    const ImageRGB image = loadImageLinear({file, "raw", camera.path, input}, diagnostics);
    if (!image.valid) return nullptr;
    std::vector<vec2> places;
    places.reserve(image.pixels.size());
    for (const vec3& pixel : image.pixels)
        places.emplace_back(pixel.x, pixel.y);
    return std::make_shared<const DistortionMap>(image.width, image.height, places);
}

vec2 DistortionMap::shown(const vec2& place) const {
    const auto axis = [](float x, int size, int& first, int& second) {
        const float t = std::clamp(x * float(size) - 0.5f, 0.0f, float(size - 1));
        first = int(t);
        second = std::min(first + 1, size - 1);
        return t - float(first);
    };
    int x0, x1, y0, y1;
    const float fx = axis(place.x, _width, x0, x1), fy = axis(place.y, _height, y0, y1);
    const auto way = [&](int x, int y) { return _ways[size_t(y) * size_t(_width) + size_t(x)]; };
    const vec2 above = way(x0, y0) * (1.0f - fx) + way(x1, y0) * fx;
    const vec2 below = way(x0, y1) * (1.0f - fx) + way(x1, y1) * fx;
    return place + (above * (1.0f - fy) + below * fy);
}

} // namespace patina
