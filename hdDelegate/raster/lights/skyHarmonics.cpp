// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/skyHarmonics.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina {

namespace {

using glm::vec3;
constexpr int width = 256, height = 128, fine = 6;
constexpr float sunRadius = 0.105f; ///< radians

vec3 directionAt(float x, float y) {
    const float phi = (x + 0.5f) / width * 2.0f * pi;
    const float theta = (y + 0.5f) / height * pi;
    return vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
}

float solidAngle(int y) {
    return (std::cos(float(y) / height * pi) - std::cos(float(y + 1) / height * pi)) * 2.0f * pi /
           width;
}

int bandOf(int i) {
    return i == 0 ? 0 : i < 4 ? 1 : 2;
}

/// Takes the dominant light out of the grid.
void split(std::vector<vec3>& sky, SkyHarmonics& out) {
    size_t brightest = 0;
    for (size_t i = 0; i < sky.size(); ++i)
        if (luminance(sky[i]) > luminance(sky[brightest])) brightest = i;
    const vec3 peak = directionAt(float(int(brightest) % width), float(int(brightest) / width));
    const auto away = [&](int x, int y) {
        return std::acos(std::clamp(glm::dot(directionAt(float(x), float(y)), peak), -1.0f, 1.0f));
    };
    vec3 around(0.0f);
    float aroundAngle = 0.0f, flux = 0.0f;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const vec3& l = sky[size_t(y) * width + size_t(x)];
            flux += luminance(l) * solidAngle(y);
            const float angle = away(x, y);
            if (angle < sunRadius || angle > 2.0f * sunRadius) continue;
            around += l * solidAngle(y);
            aroundAngle += solidAngle(y);
        }
    around /= std::max(aroundAngle, 1e-6f);
    vec3 power(0.0f), direction(0.0f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (away(x, y) >= sunRadius) continue;
            const vec3 more = glm::max(sky[size_t(y) * width + size_t(x)] - around, vec3(0.0f));
            power += more * solidAngle(y);
            direction += directionAt(float(x), float(y)) * (luminance(more) * solidAngle(y));
        }
    const float length = glm::length(direction);
    if (!(luminance(power) >= 0.1f * flux) || !(length > 0.0f)) return;
    out.sunDirection = direction / length;
    out.sunIrradiance = power;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            if (away(x, y) < sunRadius) {
                vec3& l = sky[size_t(y) * width + size_t(x)];
                l = glm::min(l, around);
            }
}

/// The lowest irradiance over 2048 normals, in any channel, relative to the mean.
float lowest(const SkyHarmonics& sky) {
    float low = INFINITY;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const vec3 e = sky.at(directionAt(4.0f * float(x) + 2.0f, 4.0f * float(y) + 2.0f));
            low = std::min(low, std::min({e.x, e.y, e.z}));
        }
    return low;
}

SkyHarmonics windowed(SkyHarmonics sky, float lambda) {
    for (int i = 0; i < 9; ++i) {
        const float l = float(bandOf(i)), laplacian = l * (l + 1.0f);
        sky.irradiance[i] /= 1.0f + lambda * laplacian * laplacian;
    }
    sky.window = lambda;
    return sky;
}

} // namespace

void shHarmonics(const vec3& d, float out[9]) {
    out[0] = 0.282094792f;
    out[1] = 0.488602512f * d.y;
    out[2] = 0.488602512f * d.z;
    out[3] = 0.488602512f * d.x;
    out[4] = 1.092548431f * d.x * d.y;
    out[5] = 1.092548431f * d.y * d.z;
    out[6] = 0.315391565f * (3.0f * d.z * d.z - 1.0f);
    out[7] = 1.092548431f * d.x * d.z;
    out[8] = 0.546274215f * (d.x * d.x - d.y * d.y);
}

vec3 SkyHarmonics::at(const vec3& normal) const {
    float y[9];
    shHarmonics(normal, y);
    vec3 sum(0.0f);
    for (int i = 0; i < 9; ++i)
        sum += irradiance[i] * y[i];
    return sum;
}

SkyHarmonics makeSkyHarmonics(const std::function<vec3(const vec3&)>& radiance, bool splitSun,
                              bool windows) {
    SkyHarmonics out;
    std::vector<vec3> sky(size_t(width) * height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            // Means over the cells, as a sun is smaller than one of them.
            vec3 sum(0.0f);
            for (int k = 0; k < fine * fine; ++k) {
                const float across = (float(k % fine) + 0.5f) / fine - 0.5f;
                const float down = (float(k / fine) + 0.5f) / fine - 0.5f;
                const vec3 l =
                    glm::max(radiance(directionAt(float(x) + across, float(y) + down)), vec3(0.0f));
                if (std::isfinite(l.x + l.y + l.z)) sum += l;
            }
            sky[size_t(y) * width + size_t(x)] = sum / float(fine * fine);
        }
    if (splitSun) split(sky, out);
    // The cosine's own coefficients, by band (Ramamoorthi and Hanrahan 2001).
    const float cosine[3] = {pi, 2.0f * pi / 3.0f, 0.25f * pi};
    glm::dvec3 sums[9] = {};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float h[9];
            shHarmonics(directionAt(float(x), float(y)), h);
            const glm::dvec3 l(sky[size_t(y) * width + size_t(x)] * solidAngle(y));
            for (int i = 0; i < 9; ++i)
                sums[i] += l * double(h[i]);
        }
    for (int i = 0; i < 9; ++i)
        out.irradiance[i] = vec3(sums[i]) * cosine[bandOf(i)];
    if (!windows || lowest(out) >= 0.0f) return out;
    float low = 0.0f, high = 1e-3f;
    while (lowest(windowed(out, high)) < 0.0f && high < 1e3f)
        high *= 2.0f;
    for (int i = 0; i < 20; ++i) {
        const float middle = 0.5f * (low + high);
        (lowest(windowed(out, middle)) < 0.0f ? low : high) = middle;
    }
    return windowed(out, high);
}

} // namespace patina
