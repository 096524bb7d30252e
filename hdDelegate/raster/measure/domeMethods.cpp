// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/measure/domeMethods.h"

#include "hdDelegate/film/sampler.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina::measure {

namespace {

using glm::vec2;
using glm::vec3;
constexpr float texelSolidAngle =
    4.0f * pi / (float(MeasuredSky::width) * float(MeasuredSky::height));

/// As of shaders/raster/lighting.frag.glsl, RasterRenderer and RasterPasses.
constexpr float lightTrust = 8.0f;
constexpr int directionCount = 4, materialSamples = 2;

float heuristic(float a, float b) {
    return a * a / std::max(a * a + b * b, 1e-30f);
}

/// The level of the image that is as wide as a sample with this density among all is alone.
float levelOf(float density) {
    return 0.5f * std::log2(1.0f / std::max(density * texelSolidAngle, 1e-20f));
}

sh::LobeSample sampleOf(const DomePoint& p, uint32_t seed, uint32_t index) {
    Sampler numbers(1, 0, seed, index);
    const vec2 a = numbers.next2(), b = numbers.next2();
    sh::LobeSample s = p.lobe.sample(vec3(a, b.x));
    if (s.wi.z <= 0.0f) s.event = 0;
    return s;
}

} // namespace

DomePoint::DomePoint(const Reflector& reflector, const vec3& n, float turn)
    : lobe(reflector), normal(n) {
    const vec3 side =
        glm::normalize(glm::cross(std::fabs(n.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), n));
    const vec3 other = glm::cross(n, side);
    x = std::cos(turn) * side + std::sin(turn) * other;
    y = glm::cross(n, x);
}

double bySampling(const DomePoint& p, const MeasuredSky& sky, int passes, uint32_t seed) {
    double sum = 0.0;
    for (int pass = 0; pass < passes; ++pass) {
        for (int n = 0; n < directionCount; ++n) {
            const uint32_t index = uint32_t(pass * directionCount + n);
            float density = 0.0f;
            const vec3 d = sky.map.sample(Sampler(0, 1, seed, index).next2(), density);
            const vec3 wi = p.toLobe(d);
            if (density <= 0.0f || wi.z <= 0.0f) continue;
            const sh::LobeEval e = p.lobe.eval(wi);
            const float chance = directionCount * sky.densityAt(d, 0.0f);
            sum += double(e.value.x * sky.radiance(d) / (density * directionCount) *
                          heuristic(lightTrust * chance, materialSamples * e.pdf));
        }
        for (int k = 0; k < materialSamples; ++k) {
            const sh::LobeSample s = sampleOf(p, seed, uint32_t(pass * materialSamples + k));
            if (s.event == 0) continue;
            const vec3 d = p.toDome(s.wi);
            const float density = materialSamples * s.pdf;
            const float lod = levelOf(density * float(pass + 1));
            const float chance = directionCount * sky.densityAt(d, std::max(lod, 0.0f));
            sum += double(s.weight.x * sky.image.at(d, lod).x / materialSamples *
                          heuristic(density, lightTrust * chance));
        }
    }
    return sum / passes;
}

double byFiltering(const DomePoint& p, const MeasuredSky& sky, int samples, uint32_t seed) {
    double sum = 0.0;
    for (int i = 0; i < samples; ++i) {
        const sh::LobeSample s = sampleOf(p, seed, uint32_t(i));
        if (s.event == 0) continue;
        const float lod = levelOf(s.pdf * float(samples));
        sum += double(s.weight.x * sky.image.at(p.toDome(s.wi), lod).x);
    }
    return sum / samples;
}

double byHarmonics(const DomePoint& p, const MeasuredSky& sky, bool bare) {
    const SkyHarmonics& h = bare ? sky.bare : sky.harmonics;
    double sum = double(p.lobe.albedo() * std::max(h.at(p.normal).x, 0.0f) / pi);
    const vec3 wi = p.toLobe(h.sunDirection);
    if (h.sunIrradiance.x > 0.0f && wi.z > 0.0f)
        sum += double(p.lobe.eval(wi).value.x * h.sunIrradiance.x);
    return sum;
}

double byPrefiltering(const DomePoint& p, const MeasuredSky& sky) {
    const vec3& wo = p.lobe.wo;
    const vec3 d = p.toDome(vec3(-wo.x, -wo.y, wo.z));
    const float alpha = p.lobe.alpha;
    const float sharp =
        sky.image
            .at(d, std::log2(
                       std::max(alpha * alpha / std::sqrt(texelSolidAngle / (4.0f * pi)), 1e-6f)))
            .x;
    if (alpha <= 0.02f) return double(p.lobe.albedo() * sharp);
    const float level = PrefilteredSky::levelOf(alpha);
    const int low = int(level), high = std::min(low + 1, PrefilteredSky::levels - 1);
    const vec2 uv = SkyTexture::place(d);
    const float rough = glm::mix(sky.prefiltered[size_t(low)].at(uv, 0).x,
                                 sky.prefiltered[size_t(high)].at(uv, 0).x, level - float(low));
    const float share = std::clamp((alpha - 0.02f) / 0.08f, 0.0f, 1.0f);
    return double(p.lobe.albedo() * glm::mix(sharp, rough, share));
}

double overTexels(const DomePoint& p, const MeasuredSky& sky) {
    double sum = 0.0;
    for (const MeasuredSky::Texel& t : sky.texels) {
        const vec3 wi = p.toLobe(t.direction);
        if (wi.z > 0.0f) sum += double(p.lobe.eval(wi).value.x * t.flux);
    }
    return sum;
}

double overDrawn(const DomePoint& p, const MeasuredSky& sky) {
    double sum = 0.0;
    for (const MeasuredSky::Drawn& drawn : sky.drawn) {
        const vec3 wi = p.toLobe(drawn.direction);
        if (wi.z <= 0.0f) continue;
        const sh::LobeEval e = p.lobe.eval(wi);
        sum += double(e.value.x * drawn.radiance / drawn.density * heuristic(drawn.density, e.pdf));
    }
    for (size_t i = 0; i < sky.drawn.size(); ++i) {
        const sh::LobeSample s = sampleOf(p, 0, uint32_t(i));
        if (s.event == 0) continue;
        const vec3 d = p.toDome(s.wi);
        sum += double(s.weight.x * sky.radiance(d) * heuristic(s.pdf, sky.map.pdf(d)));
    }
    return sum / double(sky.drawn.size());
}

double domeTruth(const DomePoint& p, const MeasuredSky& sky) {
    return p.lobe.mirrors() && p.lobe.alpha < 0.1f ? overDrawn(p, sky) : overTexels(p, sky);
}

} // namespace patina::measure
