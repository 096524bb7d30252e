// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterLightTables.h"

#include "hdDelegate/lights/resolvedLight.h"
#include "base/maths.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {}

float RectImage::sample(const vec2& u, vec2& q) const {
    ivec2 cell;
    vec2 within;
    const float chance = distribution.sample(u, cell, within);
    q = 0.5f - (vec2(cell) + within) / vec2(float(width), float(height));
    return chance * float(width) * float(height);
}

vec3 RectImage::radiance(const vec2& q) const {
    const shLights::TableCell c = shLights::rectTexels(vec3(q, 0.0f), image->width, image->height);
    return tableMix(c, image->pixels[size_t(c.low)], image->pixels[size_t(c.lowNext)],
                    image->pixels[size_t(c.high)], image->pixels[size_t(c.highNext)]);
}

const RectImage* RasterLightTables::rect(const Light& light, LightImages& images,
                                         Diagnostics& diagnostics) {
    if (light.type != LightType::Rect || !light.hasImage()) return nullptr;
    const auto image = images.image(light);
    for (const auto& known : _rects)
        if (known->image == image) return known.get();
    auto made = std::make_unique<RectImage>();
    RectImage& r = *made;
    r.image = image;
    r.first = int(_values.size());
    r.width = std::min(r.image->width, largestImage);
    r.height = std::min(r.image->height, largestImage);
    if (!hasRoom(size_t(r.width) * size_t(r.height))) {
        diagnostics.warn(light.path, "inputs:texture:file", messages::tableWithoutRoom);
        return nullptr;
    }
    std::vector<float> weights;
    double mean = 0.0;
    for (int y = 0; y < r.height; ++y)
        for (int x = 0; x < r.width; ++x) {
            // Means over the cell: of its texels what is shown, and of what lies between them,
            // which interpolation spreads from neighbours, the density.
            const int nx = (r.image->width + r.width - 1) / r.width;
            const int ny = (r.image->height + r.height - 1) / r.height;
            const auto meanOf = [&](int across, int down) {
                vec3 sum(0.0f);
                for (int k = 0; k < across * down; ++k) {
                    const vec2 in((float(k % across) + 0.5f) / float(across),
                                  (float(k / across) + 0.5f) / float(down));
                    const vec2 size = vec2(float(r.width), float(r.height));
                    sum += r.radiance(0.5f - (vec2(float(x), float(y)) + in) / size);
                }
                return glm::max(sum / float(across * down), vec3(0.0f));
            };
            _values.emplace_back(meanOf(nx, ny), 0.0f);
            const vec3 dense = meanOf(std::max(nx, 4), std::max(ny, 4));
            weights.push_back(dense.x + dense.y + dense.z);
            mean += double(weights.back());
        }
    mean /= double(weights.size());
    r.mean = std::isfinite(mean) ? float(mean / 3.0) : 0.0f;
    if (!(mean > 0.0) || !std::isfinite(mean)) {
        mean = 1.0;
        std::fill(weights.begin(), weights.end(), 1.0f);
    }
    // Some samples everywhere, for what interpolation spreads into dark cells.
    for (float& w : weights)
        w = 0.9f * w + 0.1f * float(mean);
    for (size_t i = 0; i < weights.size(); ++i)
        _values[size_t(r.first) + i].w = weights[i] / float(mean);
    r.distribution = Distribution2d(r.width, r.height, weights);
    _rects.push_back(std::move(made));
    return _rects.back().get();
}

ProfileTable RasterLightTables::profile(const Light& light, Diagnostics& diagnostics) {
    const auto known = _profiles.find(&light);
    if (known != _profiles.end()) return known->second;
    ProfileTable& out = _profiles[&light];
    const auto profile = lightProfile(light, diagnostics);
    if (!profile) return out;
    const ProfileGrid grid = profileGrid(light, *profile, 361, 73);
    if (!hasRoom(grid.values.size())) {
        diagnostics.warn(light.path, "inputs:shaping:ies:file", messages::tableWithoutRoom);
        return out;
    }
    out = {int(_values.size()), grid.thetas, grid.phis, 0.0f};
    for (float v : grid.values) {
        _values.emplace_back(v, 0.0f, 0.0f, 0.0f);
        out.largest = std::max(out.largest, v);
    }
    return out;
}

int RasterLightTables::add(const std::vector<vec4>& values) {
    if (!hasRoom(values.size())) return -1;
    const int first = int(_values.size());
    _values.insert(_values.end(), values.begin(), values.end());
    return first;
}

void RasterLightTables::upload(int room) {
    _firstOfPass = int(_values.size());
    _room = room;
    _values.resize(_values.size() + size_t(room), vec4(0.0f));
    _buffer = GlBuffer(_values);
    _values = {};
}

void RasterLightTables::writePass(const std::vector<vec4>& values) const {
    const size_t count = std::min(values.size(), size_t(_room));
    if (count > 0)
        _buffer.write(values.data(), count * sizeof(vec4), size_t(_firstOfPass) * sizeof(vec4));
}

} // namespace patina
