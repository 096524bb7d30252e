#include "hdDelegate/raster/lights/rasterLightTables.h"

#include "materialNetwork/diagnostics.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

vec3 bilinear(const ImageRGB& image, const vec2& q) {
    const int w = image.width, h = image.height;
    const float x = std::clamp((0.5f - q.x) * float(w) - 0.5f, 0.0f, float(w - 1));
    const float y = std::clamp((0.5f - q.y) * float(h) - 0.5f, 0.0f, float(h - 1));
    const int x0 = int(x), y0 = int(y), x1 = std::min(x0 + 1, w - 1), y1 = std::min(y0 + 1, h - 1);
    const auto at = [&](int i, int k) { return image.pixels[size_t(k) * size_t(w) + size_t(i)]; };
    return glm::mix(glm::mix(at(x0, y0), at(x1, y0), x - float(x0)),
                    glm::mix(at(x0, y1), at(x1, y1), x - float(x0)), y - float(y0));
}

} // namespace

float RectImage::sample(const vec2& u, vec2& q) const {
    ivec2 cell;
    vec2 within;
    const float chance = distribution.sample(u, cell, within);
    q = 0.5f - (vec2(cell) + within) / vec2(float(width), float(height));
    return chance * float(width) * float(height);
}

vec3 RectImage::radiance(const vec2& q) const {
    return bilinear(*image, q);
}

const RectImage* RasterLightTables::rect(const Light& light, LightImages& images) {
    if (light.type != LightType::Rect || light.textureFile.empty()) return nullptr;
    auto made = std::make_unique<RectImage>();
    RectImage& r = *made;
    r.image =
        images.image(light.textureFile, light.textureColorSpace, light.path, "inputs:texture:file");
    r.first = int(_values.size());
    r.width = std::min(r.image->width, largestImage);
    r.height = std::min(r.image->height, largestImage);
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

ProfileTable RasterLightTables::profile(const Light& light) {
    ProfileTable out;
    if (light.iesFile.empty() || light.type == LightType::Dome || light.type == LightType::Distant)
        return out;
    IesProfile profile;
    std::string error;
    if (!profile.load(light.iesFile, error)) {
        _diagnostics.warn(light.path, "inputs:shaping:ies:file", error);
        return out;
    }
    const float mean = profile.mean();
    const float scale = !light.iesNormalize ? 1.0f : mean > 0.0f ? 1.0f / mean : 0.0f;
    out.thetas = 361;
    out.phis = 73;
    std::vector<float> values;
    bool round = true;
    for (int p = 0; p < out.phis; ++p)
        for (int t = 0; t < out.thetas; ++t) {
            const float theta =
                IesProfile::scaledTheta(float(t) / float(out.thetas - 1) * pi, light.iesAngleScale);
            const float phi = float(p) / float(out.phis - 1) * 2.0f * pi;
            values.push_back(profile.candela(theta, phi) * scale);
            const float first = values[size_t(t)];
            round &= std::fabs(values.back() - first) <= 1e-4f * std::fabs(first);
        }
    if (round) {
        out.phis = 1;
        values.resize(size_t(out.thetas));
    }
    out.first = int(_values.size());
    for (float v : values)
        _values.emplace_back(v, 0.0f, 0.0f, 0.0f);
    return out;
}

int RasterLightTables::add(const std::vector<vec4>& values) {
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
