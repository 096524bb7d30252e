// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/backends/refine.h"

#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>

namespace patina {

using glm::vec3;
using glm::vec4;

namespace {

constexpr int radius = 8; // pixels: a mean over 289 of them has 1/17 of the noise
constexpr float halfAt = 0.05f;
constexpr float maxGain = 4.0f;

template <class Body> void eachPixel(const Picture& p, const Body& body) {
    parallelFor(0, p.height, [&](int y) {
        for (size_t i = size_t(y) * size_t(p.width), n = i + size_t(p.width); i < n; ++i)
            body(i);
    });
}

} // namespace

Picture noiseOf(const Film& traced) {
    Picture noise{traced.width(), traced.height(), {}};
    noise.pixels.resize(size_t(traced.width()) * size_t(traced.height()));
    parallelFor(0, traced.height(), [&](int y) {
        vec4* row = &noise.pixels[size_t(y) * size_t(traced.width())];
        for (int x = 0; x < traced.width(); ++x)
            row[x] = vec4(traced.varianceOfMean(x, y), traced.sampleCount(x, y) < 2, 0.0f, 0.0f);
    });
    return noise;
}

Picture refine(Picture rasterized, const Picture& traced, const Picture& noise, float done) {
    const Picture tracedMean = boxBlur(traced, radius), mean = boxBlur(rasterized, radius);
    Picture rest = traced;
    eachPixel(rest, [&](size_t i) {
        vec4& quick = rasterized.pixels[i];
        for (int k = 0; k < 3; ++k) {
            const float to = tracedMean.pixels[i][k], from = mean.pixels[i][k];
            const float gain = from != 0.0f ? to / from : 1.0f;
            quick[k] *= std::clamp(gain, 1.0f / maxGain, maxGain);
        }
        rest.pixels[i] = traced.pixels[i] - quick;
    });
    rest = boxBlur(rest, radius);
    const Picture localNoise = boxBlur(noise, radius / 2);
    Picture result = traced;
    eachPixel(result, [&](size_t i) {
        if (traced.pixels[i].w == 0.0f) return; // nothing there: no light of neighbours leaks in
        const float l = luminance(glm::abs(vec3(tracedMean.pixels[i]))) + 1e-4f;
        const float relative = localNoise.pixels[i].x / (l * l) + localNoise.pixels[i].y;
        const float clear = halfAt * halfAt / (halfAt * halfAt + relative);
        const float weight = clear + (1.0f - clear) * done * done;
        vec3 moved(rasterized.pixels[i] + rest.pixels[i]);
        for (int k = 0; k < 3; ++k) // lights that take light away leave less than none
            if (!(tracedMean.pixels[i][k] < 0.0f)) moved[k] = std::max(moved[k], 0.0f);
        result.pixels[i] =
            vec4(glm::mix(moved, vec3(traced.pixels[i]), weight), traced.pixels[i].w);
    });
    return result;
}

} // namespace patina
