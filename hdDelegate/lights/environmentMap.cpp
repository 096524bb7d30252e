// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/environmentMap.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {
constexpr int largestGridWidth = 2048;

float longitudeFraction(const vec3& d) {
    const float u = 0.5f - std::atan2(d.x, d.z) / (2.0f * pi);
    return u - std::floor(u);
}

vec3 direction(float u, float cosine) {
    const float longitude = (0.5f - u) * 2.0f * pi;
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    return vec3(sine * std::sin(longitude), cosine, sine * std::cos(longitude));
}

} // namespace

EnvironmentFormat environmentFormat(const std::string& name) {
    if (name == "latlong") return EnvironmentFormat::Latlong;
    if (name == "mirroredBall") return EnvironmentFormat::MirroredBall;
    if (name == "angular") return EnvironmentFormat::Angular;
    if (name == "cubeMapVerticalCross") return EnvironmentFormat::CubeMapVerticalCross;
    return EnvironmentFormat::Automatic;
}

EnvironmentMap::EnvironmentMap(std::shared_ptr<const ImageRGB> image, EnvironmentFormat format)
    : _image(std::move(image)), _format(format) {
    if (!_image || _image->width < 1 || _image->height < 1 ||
        _image->pixels.size() < size_t(_image->width) * size_t(_image->height)) {
        auto black = std::make_shared<ImageRGB>();
        black->width = black->height = 1;
        black->pixels.assign(1, vec3(0.0f));
        _image = black;
    }
    if (_format == EnvironmentFormat::Automatic)
        _format = _image->width * 4 == _image->height * 3 ? EnvironmentFormat::CubeMapVerticalCross
                                                          : EnvironmentFormat::Latlong;
    build();
}

/// Texel centres stand at half integers. Longitude wraps around, everything else stops at the edge.
vec3 EnvironmentMap::bilinear(float x, float y, bool wrap) const {
    const int w = _image->width, h = _image->height;
    const float fx = x - 0.5f, fy = std::clamp(y - 0.5f, 0.0f, float(h - 1));
    const float x0f = std::floor(fx);
    const int y0 = std::min(int(fy), h - 1), y1 = std::min(y0 + 1, h - 1);
    const float tx = fx - x0f, ty = fy - float(y0);
    int x0 = int(x0f), x1 = x0 + 1;
    if (wrap) {
        x0 = (x0 % w + w) % w;
        x1 = (x1 % w + w) % w;
    } else {
        x0 = std::clamp(x0, 0, w - 1);
        x1 = std::clamp(x1, 0, w - 1);
    }
    const vec3* top = &_image->pixels[size_t(y0) * size_t(w)];
    const vec3* bottom = &_image->pixels[size_t(y1) * size_t(w)];
    return (1.0f - ty) * ((1.0f - tx) * top[x0] + tx * top[x1]) +
           ty * ((1.0f - tx) * bottom[x0] + tx * bottom[x1]);
}

/// The same within one face of a cross, so that faces do not bleed.
vec3 EnvironmentMap::bilinearIn(float x, float y, int x0, int y0, int x1, int y1) const {
    return bilinear(std::clamp(x, float(x0) + 0.5f, float(x1) - 0.5f),
                    std::clamp(y, float(y0) + 0.5f, float(y1) - 0.5f), false);
}

vec3 EnvironmentMap::cross(const vec3& d) const {
    const vec3 a = glm::abs(d);
    int column = 1, row = 1;
    float s, t; // -1..1, right and down in the face
    if (a.y >= a.x && a.y >= a.z) {
        row = d.y > 0.0f ? 0 : 2;
        s = -d.x / a.y;
        t = d.z / d.y; // the face's edge at the middle row is +z
    } else if (a.x >= a.z) {
        column = d.x > 0.0f ? 0 : 2;
        s = d.z / d.x;
        t = -d.y / a.x;
    } else if (d.z > 0.0f) {
        s = -d.x / a.z;
        t = -d.y / a.z;
    } else {
        row = 3; // reached over -y, so that it hangs upside down
        s = -d.x / a.z;
        t = d.y / a.z;
    }
    const float w = float(_image->width) / 3.0f, h = float(_image->height) / 4.0f;
    const float x = (float(column) + 0.5f * (s + 1.0f)) * w;
    const float y = (float(row) + 0.5f * (t + 1.0f)) * h;
    return bilinearIn(x, y, int(float(column) * w), int(float(row) * h), int(float(column + 1) * w),
                      int(float(row + 1) * h));
}

vec3 EnvironmentMap::radiance(const vec3& d) const {
    const float w = float(_image->width), h = float(_image->height);
    switch (_format) {
    case EnvironmentFormat::CubeMapVerticalCross: return cross(d);
    case EnvironmentFormat::MirroredBall:
    case EnvironmentFormat::Angular: {
        const float angle = std::acos(std::clamp(d.z, -1.0f, 1.0f));
        const float across = std::sqrt(d.x * d.x + d.y * d.y);
        // The ball's normal stands at half the angle of the reflection.
        const float r = _format == EnvironmentFormat::Angular ? angle / pi : std::sin(0.5f * angle);
        const float scale = across > 0.0f ? r / across : 0.0f;
        return bilinear(0.5f * w * (1.0f - d.x * scale), 0.5f * h * (1.0f - d.y * scale), false);
    }
    default:
        return bilinear(longitudeFraction(d) * w, std::acos(std::clamp(d.y, -1.0f, 1.0f)) / pi * h,
                        true);
    }
}

/// Radiance per cell of a grid: box filtered texels of a latlong, point samples of other formats.
std::vector<vec3> EnvironmentMap::latlongGrid(int width, int height) const {
    std::vector<vec3> grid(size_t(width) * size_t(height), vec3(0.0f));
    const bool latlong = _format == EnvironmentFormat::Latlong;
    const auto texel = [](int cell, int cells, int texels) {
        return int(int64_t(cell) * texels / cells);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            vec3& cell = grid[size_t(y) * size_t(width) + size_t(x)];
            if (!latlong) {
                const float cosine = std::cos(pi * (float(y) + 0.5f) / float(height));
                cell = radiance(direction((float(x) + 0.5f) / float(width), cosine));
                continue;
            }
            int count = 0;
            const int bottom = texel(y + 1, height, _image->height);
            const int right = texel(x + 1, width, _image->width);
            for (int k = texel(y, height, _image->height); k < bottom; ++k)
                for (int i = texel(x, width, _image->width); i < right; ++i, ++count)
                    cell += _image->pixels[size_t(k) * size_t(_image->width) + size_t(i)];
            cell /= float(std::max(count, 1));
        }
    return grid;
}

void EnvironmentMap::build() {
    int width = _image->width, height = _image->height;
    if (_format == EnvironmentFormat::Latlong) {
        // Whole factors where there are any, so that cells and texels share their edges.
        constexpr int leastGridWidth = 256;
        int factor = 1;
        while (width / factor > largestGridWidth || width % factor || height % factor)
            if (++factor > width / leastGridWidth) break;
        if (width <= largestGridWidth) {
            factor = 1;
        } else if (width % factor || height % factor || width / factor > largestGridWidth) {
            height = std::max(1, int(int64_t(height) * largestGridWidth / width));
            width = largestGridWidth;
            factor = 1;
        }
        width /= factor;
        height /= factor;
    } else {
        width = std::clamp(2 * std::max(width, height), 32, largestGridWidth);
        height = width / 2;
    }
    const std::vector<vec3> grid = latlongGrid(width, height);
    _cosines.resize(size_t(height) + 1);
    for (int y = 0; y <= height; ++y)
        _cosines[y] = float(std::cos(piDouble * y / height));

    // A cell's share of bilinear interpolation is (1, 6, 1) / 8 of itself and its neighbours, along
    // both axes.
    const auto at = [&](int x, int y) -> const vec3& {
        return grid[size_t(std::clamp(y, 0, height - 1)) * size_t(width) +
                    size_t((x + width) % width)];
    };
    std::vector<float> weights(grid.size());
    glm::dvec3 sum(0.0);
    for (int y = 0; y < height; ++y) {
        const float band = bandHeight(y);
        for (int x = 0; x < width; ++x) {
            vec3 c(0.0f);
            for (int k = -1; k <= 1; ++k)
                for (int i = -1; i <= 1; ++i)
                    c += at(x + i, y + k) * ((k ? 0.125f : 0.75f) * (i ? 0.125f : 0.75f));
            sum += glm::dvec3(c) * double(band);
            const float l = luminance(c);
            weights[size_t(y) * size_t(width) + size_t(x)] = l > 0.0f ? l * band : 0.0f;
        }
    }
    _mean = vec3(sum / (2.0 * width));
    _distribution = SkyDistribution(width, height, weights);
}

float EnvironmentMap::bandHeight(int row) const {
    return _cosines[row] - _cosines[row + 1];
}

/// Asks for the texels around a place on a latlong image; about the right ones are enough.
void EnvironmentMap::fetchTexels(float u, float v) const {
    const int w = _image->width, h = _image->height;
    const int x = std::clamp(int(u * float(w) - 0.5f), 0, w - 2 + int(w == 1));
    const int y = std::clamp(int(v * float(h) - 0.5f), 0, h - 2 + int(h == 1));
    const vec3* top = &_image->pixels[size_t(y) * size_t(w) + size_t(x)];
    const vec3* bottom = h > 1 ? top + w : top;
    const int last = w > 1 ? 1 : 0;
    __builtin_prefetch(top);
    __builtin_prefetch(bottom);
    __builtin_prefetch(&top[last].z);
    __builtin_prefetch(&bottom[last].z);
}

vec3 EnvironmentMap::sample(const vec2& u, float& pdf, const vec3& normal, bool twoSided) const {
    return sample(begin(u, normal, twoSided), pdf);
}

vec3 EnvironmentMap::sample(const SkyDistribution::Draw& draw, float& pdf) const {
    glm::ivec2 cell;
    vec2 within;
    const float probability = _distribution.sample(draw, cell, within);
    const float width = float(_distribution.width());
    pdf = probability * width / (2.0f * pi * bandHeight(cell.y));
    const float cosine = _cosines[cell.y] - within.y * bandHeight(cell.y);
    const float u = (float(cell.x) + within.x) / width;
    if (_format == EnvironmentFormat::Latlong)
        fetchTexels(u, (float(cell.y) + within.y) / float(_distribution.height()));
    return direction(u, cosine);
}

EnvironmentMap::Place EnvironmentMap::place(const vec3& d) const {
    const Place result{d, longitudeFraction(d), std::acos(std::clamp(d.y, -1.0f, 1.0f)) / pi};
    if (_format == EnvironmentFormat::Latlong) fetchTexels(result.u, result.v);
    _distribution.fetch(cellAt(result));
    return result;
}

glm::ivec2 EnvironmentMap::cellAt(const Place& place) const {
    const int width = _distribution.width(), height = _distribution.height();
    return {std::clamp(int(place.u * float(width)), 0, width - 1),
            std::clamp(int(place.v * float(height)), 0, height - 1)};
}

vec3 EnvironmentMap::radiance(const Place& place) const {
    if (_format != EnvironmentFormat::Latlong) return radiance(place.direction);
    return bilinear(place.u * float(_image->width), place.v * float(_image->height), true);
}

float EnvironmentMap::pdf(const Place& place, const vec3& normal, bool twoSided) const {
    const glm::ivec2 cell = cellAt(place);
    return _distribution.probability(cell, normal, twoSided) * float(_distribution.width()) /
           (2.0f * pi * bandHeight(cell.y));
}

float EnvironmentMap::pdf(const vec3& d, const vec3& normal, bool twoSided) const {
    return pdf(place(d), normal, twoSided);
}

} // namespace patina
