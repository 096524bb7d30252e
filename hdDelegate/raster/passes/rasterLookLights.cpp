// SPDX-License-Identifier: Apache-2.0
// The samples that a first look takes of the lights.

#include "hdDelegate/raster/lights/rasterLights.h"
#include "hdDelegate/raster/passes/lookWeights.h"
#include "hdDelegate/raster/passes/passNumbers.h"
#include "hdDelegate/raster/passes/rasterLook.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int every = RasterLights::lookEvery;
constexpr int maxPooled = 32;        ///< of a dome; half as many of an area
constexpr int drawnOfDome = 2048;    ///< directions, to tell what is peaked, and what all light
constexpr int maxPeaks = 4;          ///< samples of what is peaked, which all pixels take
constexpr float peakDensity = 10.0f; ///< by solid angle
/// Narrower suns have one sample: 1 - cosine of half the angle of 3 degrees.
constexpr float sharpSun = 3.4e-4f;

} // namespace

/// As many as there is a use for; 1 where all are alike.
int RasterLights::lookSamples(const Source& s) const {
    if (s.kind == Dome) return _domeSamples > 0 ? maxPooled : 1;
    if (s.kind == Distant) return s.fixed.versine > sharpSun ? maxPooled / 2 : 1;
    return s.kind == Point || (s.delta && s.kind != Line) ? 1 : maxPooled / 2;
}

void RasterLights::addLook(const Source& s, size_t number, uint32_t pass, int samples, int mapped,
                           const ShadowBounds& bounds, int maximum, Sampled& out,
                           std::vector<GpuLight>& looked, std::vector<GpuLight>& shared,
                           std::vector<GpuLight>& pool) const {
    const uint32_t set = 100 + 16 * uint32_t(number);
    const bool dome = s.kind == Dome;
    const auto cast = [&](GpuLight& g, uint32_t index) {
        if (!_shadows || !s.shadows) return;
        if (dome && _domeSamples == 0)
            g.castBySky();
        else
            castShadow(g, s.shadowCategory, passNumbers(_seed, index, set + 1), bounds, maximum,
                       out);
    };
    if (samples == 1) {
        GpuLight g = draw(s, threeNumbers(_seed, pass, set));
        cast(g, pass);
        if (!s.delta) looked.push_back(g);
        shared.push_back(g);
        return;
    }
    const uint32_t drawn = dome ? drawnOfDome : uint32_t(samples);
    std::vector<std::pair<uint32_t, GpuLight>> all, peaks;
    for (uint32_t n = 0; n < drawn; ++n) {
        const uint32_t index = pass * drawn + n;
        GpuLight g = draw(s, threeNumbers(_seed, index, set));
        (dome && g.density > peakDensity ? peaks : all).emplace_back(index, g);
    }
    const float found = float(all.size()) / float(drawn);
    const auto toSamples = [&] {
        std::vector<DomeSample> to;
        for (const auto& [index, g] : all) {
            // The light that samples of diffuse BSDFs leave to them: see fromLight() in
            // lighting.frag.glsl.
            const float own = float(samples / every) * g.density;
            const float diffuse = float(RasterLook::bsdfSamples) * 0.2f;
            const float share = own * own / std::max(own * own + diffuse * diffuse, 1e-20f);
            to.push_back({g.sampled, g.radiance * (share / g.density)});
        }
        return to;
    };
    const std::vector<DomeSample> many = dome ? toSamples() : std::vector<DomeSample>();
    if (all.size() > size_t(samples)) all.resize(size_t(samples));
    all.resize(all.size() / every * every);
    if (dome) {
        const std::vector<vec3> factors = lookWeights(toSamples(), many);
        for (size_t k = 0; k < all.size(); ++k)
            all[k].second.radiance *= factors[k];
    }
    const size_t shares = std::min<size_t>(peaks.size(), maxPeaks);
    const float perPixel = float(samples / every);
    int taken = 0;
    std::vector<size_t> origins; // of pool, whose maps others use
    const auto take = [&](uint32_t index, GpuLight g, float weight, std::vector<GpuLight>& to) {
        if (dome) {
            // Densities of domes are those of all samples together.
            g.domeSamples = 1.0f;
            g.kind = MoreDome;
        }
        g.perPixel = perPixel;
        g.weight = weight;
        const int number = taken++;
        if (number < mapped || &to == &shared) {
            cast(g, index);
            if (!dome) origins.push_back(to.size());
        } else if (_shadows && s.shadows && dome) {
            g.castBySky();
        } else if (!origins.empty()) {
            const size_t origin = origins[size_t(number) % origins.size()];
            g.firstMap = to[origin].firstMap;
            g.maps = to[origin].maps;
            g.fibreMaps = to[origin].fibreMaps;
            if (g.firstMap >= 0 && g.is(shLights::LIGHT_AT_PLACE)) g.mapsFrom = int(origin);
        }
        to.push_back(g);
    };
    // Those that are taken are as bright as all are.
    const auto light = [](const GpuLight& g) { return g.radiance / g.density; };
    vec3 wanted(0.0f), had(0.0f);
    for (const auto& peak : peaks)
        wanted += light(peak.second) / float(peaks.size());
    for (size_t k = 0; k < shares; ++k)
        had += light(peaks[k * peaks.size() / shares].second) / float(shares);
    for (size_t k = 0; k < shares; ++k) {
        auto& peak = peaks[k * peaks.size() / shares];
        for (int c = 0; c < 3; ++c)
            if (had[c] > 0.0f) peak.second.radiance[c] *= wanted[c] / had[c];
        take(peak.first, peak.second, (1.0f - found) / float(shares), shared);
    }
    for (const auto& [index, g] : all)
        take(index, g, found / float(all.size()), pool);
    GpuLight g = !pool.empty() ? pool.back() : !shared.empty() ? shared.back() : s.fixed;
    g.kind = s.kind;
    g.perPixel = perPixel;
    g.weight = 1.0f;
    if (s.kind != Line) looked.push_back(g);
}

RasterLights::Sampled RasterLights::sampleLook(uint32_t pass, const RasterEmitters& emitters,
                                               const ShadowBounds& bounds, int mapSize, int pixels,
                                               int maximum, int most) const {
    if (_pixelsChoose) {
        Sampled out = sample(pass, emitters, bounds, mapSize, pixels, most);
        out.sharedEvery = every;
        return out;
    }
    const auto mapsEach = [&](const Source& s) {
        if (!_shadows || !s.shadows) return 0;
        if (s.kind == Dome) return _domeSamples > 0 ? 1 : 0;
        return mapsOf(s, bounds);
    };
    maximum = std::min(maximum, int(maxSmallMaps));
    const auto needed = [&](int pooled) {
        int maps = 0, lights = 0;
        for (const Source& s : _sources) {
            const int samples = std::min(lookSamples(s), s.kind == Dome ? pooled : pooled / 2);
            const int n = samples < every ? 1 : samples;
            maps += mapsEach(s) * (s.kind == Dome ? n + maxPeaks : n);
            lights += n + (s.kind == Dome ? maxPeaks : 0) + 1;
        }
        return lights <= maxTaken - maxCoarseSamples ? maps : 1 << 20;
    };
    const int emitterMaps = emitters.empty() || !_shadows ? 0 : 6;
    int pooled = maxPooled;
    while (pooled > every && needed(pooled) + emitterMaps * minEmitterSamples > maximum)
        pooled /= 2;
    Sampled out;
    if (bounds.hasFibres() || needed(pooled) + emitterMaps * minEmitterSamples > maximum) {
        out = sample(pass, emitters, bounds, mapSize, pixels);
        out.sharedEvery = every;
        return out;
    }
    int emitterSamples = 0;
    if (!emitters.empty()) {
        const int room =
            emitterMaps > 0 ? (maximum - needed(pooled)) / emitterMaps : maxCoarseSamples;
        emitterSamples = std::clamp(room, int(minEmitterSamples), int(maxCoarseSamples));
        if (emitterSamples >= every) emitterSamples = emitterSamples / every * every;
    }
    const bool many = needed(pooled) + emitterMaps * emitterSamples > maxMaps;
    out.mapSize = enoughFor(pixels, many ? mapSize / 2 : mapSize);
    std::vector<GpuLight> looked, shared, pool;
    for (size_t i = 0; i < _sources.size(); ++i) {
        const Source& s = _sources[i];
        const int samples = std::min(lookSamples(s), s.kind == Dome ? pooled : pooled / 2);
        addLook(s, i, pass, samples < every ? 1 : samples, maxTaken, bounds, maximum, out, looked,
                shared, pool);
    }
    takeEmitters(pass, emitterSamples, emitters, bounds, maximum, out);
    std::vector<GpuLight>& glowing = emitterSamples >= every ? pool : shared;
    glowing.insert(glowing.end(), out.lights.begin(), out.lights.end());
    join(out, looked, shared, std::move(pool));
    out.many = pooled == maxPooled;
    return out;
}

void RasterLights::join(Sampled& out, const std::vector<GpuLight>& looked,
                        const std::vector<GpuLight>& shared, std::vector<GpuLight> pool) {
    const size_t first = looked.size() + shared.size();
    for (GpuLight& g : pool)
        if (g.mapsFrom >= 0) g.mapsFrom += int(first);
    out.lights = looked;
    out.lights.insert(out.lights.end(), shared.begin(), shared.end());
    out.lights.insert(out.lights.end(), pool.begin(), pool.end());
    out.taken = int(out.lights.size());
    out.found = out.firstSampled = int(looked.size());
    out.firstShared = int(first);
    out.sharedEvery = every;
}

RasterLights::Sampled RasterLights::sampleFirst(const RasterEmitters& emitters,
                                                const ShadowBounds& bounds, int mapSize, int pixels,
                                                int maximum) const {
    Sampled out;
    maximum = std::min(maximum, int(maxSmallMaps));
    int lights = 0, single = 0, pooled = 0; // maps for one sample of each light
    for (const Source& s : _sources) {
        const int samples = lookSamples(s);
        lights += samples + (s.kind == Dome ? maxPeaks : 0) + 1;
        const int maps = !_shadows || !s.shadows || s.kind == Dome ? 0 : mapsOf(s, bounds);
        single += maps;
        if (samples > 1) pooled += maps;
    }
    const int emitterMaps = emitters.empty() || !_shadows ? 0 : 6 * minEmitterSamples;
    if (_pixelsChoose || bounds.hasFibres() || lights > maxTaken - minEmitterSamples ||
        single + emitterMaps > std::max(maximum, int(maxMaps)))
        return out;
    // Lights that are sharp have one sample, and its maps.
    const int mapped = pooled > 0 ? std::clamp((maximum - emitterMaps - (single - pooled)) / pooled,
                                               1, maxPooled / 2)
                                  : 1;
    const bool many = emitterMaps + single - pooled + mapped * pooled > maxMaps;
    out.mapSize = enoughFor(pixels, many ? mapSize / 2 : mapSize);
    std::vector<GpuLight> looked, shared, pool;
    for (size_t i = 0; i < _sources.size(); ++i)
        addLook(_sources[i], i, 0, lookSamples(_sources[i]), _sources[i].kind == Dome ? 0 : mapped,
                bounds, int(maxSmallMaps), out, looked, shared, pool);
    takeEmitters(0, emitters.empty() ? 0 : minEmitterSamples, emitters, bounds, maxSmallMaps, out);
    shared.insert(shared.end(), out.lights.begin(), out.lights.end());
    join(out, looked, shared, std::move(pool));
    return out;
}

} // namespace patina
