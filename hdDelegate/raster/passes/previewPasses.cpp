// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/previewPasses.h"

#include "hdDelegate/parallel.h"
#include "hdDelegate/raster/samples/previewWeights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using Source = RasterLightSource;

constexpr int every = 8;             ///< a pixel takes an eighth of a light's samples
constexpr int maxPooled = 32;        ///< of a dome; half as many of an area
constexpr int drawnOfDome = 2048;    ///< directions, to tell what is peaked, and what all light
constexpr int maxPeaks = 4;          ///< samples of what is peaked, which all pixels take
constexpr float peakDensity = 10.0f; ///< by solid angle
/// Narrower suns have one sample: 1 - cosine of half the angle of 3 degrees.
constexpr float sharpSun = 3.4e-4f;

} // namespace

struct PreviewSampler::Parts {
    SampledLights out;
    std::vector<GpuLight> looked, shared, pool;

    /// Puts the lights together.
    SampledLights join() {
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
        return std::move(out);
    }
};

/// As many as there is a use for; 1 where all are alike.
/// @param pooled at most, of a dome
int PreviewSampler::samplesOf(const Source& s, int pooled) const {
    if (s.kind == Source::Dome) return _lights.domeSamples() > 0 ? pooled : 1;
    const bool one = s.kind == Source::Distant
                         ? !(s.fixed.versine > sharpSun)
                         : s.kind == Source::Point || (s.delta && s.kind != Source::Line);
    return one || pooled / 2 < every ? 1 : pooled / 2;
}

void PreviewSampler::add(size_t number, int samples, int mapped, int maximum, Parts& parts) const {
    const Source& s = _sources[number];
    std::vector<GpuLight>&looked = parts.looked, &shared = parts.shared, &pool = parts.pool;
    ShadowPlan& shadows = parts.out.shadows;
    const uint32_t set = setOf(number);
    const bool dome = s.kind == Source::Dome;
    if (samples == 1) {
        GpuLight g = s.sample(threeNumbers(_pass, set));
        cast(g, number, _pass, maximum, shadows);
        if (!s.delta) looked.push_back(g);
        shared.push_back(g);
        return;
    }
    const uint32_t drawn = dome ? drawnOfDome : uint32_t(samples);
    std::vector<std::pair<uint32_t, GpuLight>> all, peaks;
    for (uint32_t n = 0; n < drawn; ++n) {
        const uint32_t index = _pass * drawn + n;
        GpuLight g = s.sample(threeNumbers(index, set));
        (dome && g.density > peakDensity ? peaks : all).emplace_back(index, g);
    }
    const float found = float(all.size()) / float(drawn);
    const auto toSamples = [&] {
        std::vector<DomeSample> to;
        for (const auto& [index, g] : all) {
            // The light that samples of diffuse BSDFs leave to them: see fromLight() in
            // lighting.frag.glsl.
            const float own = float(samples / every) * g.density;
            const float diffuse = float(PreviewPasses::bsdfSamples) * 0.2f;
            const float share = own * own / std::max(own * own + diffuse * diffuse, 1e-20f);
            to.push_back({g.sampled, g.radiance * (share / g.density)});
        }
        return to;
    };
    const std::vector<DomeSample> many = dome ? toSamples() : std::vector<DomeSample>();
    if (all.size() > size_t(samples)) all.resize(size_t(samples));
    all.resize(all.size() / every * every);
    if (dome) {
        const std::vector<vec3> factors = previewWeights(toSamples(), many);
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
            g.kind = shLights::LIGHT_MORE_DOME;
        }
        g.perPixel = perPixel;
        g.weight = weight;
        const int nth = taken++;
        if (nth < mapped || &to == &shared) {
            cast(g, number, index, maximum, shadows);
            if (!dome) origins.push_back(to.size());
        } else if (s.shadows && dome) {
            g.castBySky();
        } else if (!origins.empty()) {
            const size_t origin = origins[size_t(nth) % origins.size()];
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
    if (s.kind != Source::Line) looked.push_back(g);
}

SampledLights PreviewSampler::samplePreview(int maximum, int most) const {
    const auto asInAllPasses = [&](int maps) {
        SampledLights out = sample(maps);
        out.sharedEvery = every;
        return out;
    };
    if (_lights.pixelsChoose()) return asInAllPasses(most);
    maximum = std::min(maximum, int(ShadowPlan::maxSmallMaps));
    const auto needed = [&](int pooled) {
        int maps = 0, lights = 0;
        for (const Source& s : _sources) {
            const int peaks = s.kind == Source::Dome ? maxPeaks : 0, n = samplesOf(s, pooled);
            const int each = mapsOf(s, _bounds);
            maps += (peaks > 0 ? std::min(each, 1) : each) * (n + peaks);
            lights += n + peaks + 1;
        }
        return lights <= maxTaken - RasterEmitters::maxSamples ? maps : 1 << 20;
    };
    const int emitterMaps = _emitters.empty() || !_lights.castShadows() ? 0 : 6;
    int pooled = maxPooled;
    while (pooled > every && needed(pooled) + emitterMaps * minEmitterSamples > maximum)
        pooled /= 2;
    if (_bounds.hasFibres() || needed(pooled) + emitterMaps * minEmitterSamples > maximum)
        return asInAllPasses(ShadowPlan::maxSmallMaps);
    int emitterSamples = 0;
    if (!_emitters.empty()) {
        const int room =
            emitterMaps > 0 ? (maximum - needed(pooled)) / emitterMaps : RasterEmitters::maxSamples;
        emitterSamples = std::clamp(room, minEmitterSamples, RasterEmitters::maxSamples);
        if (emitterSamples >= every) emitterSamples = emitterSamples / every * every;
    }
    const bool small = needed(pooled) + emitterMaps * emitterSamples > ShadowPlan::maxMaps;
    Parts parts;
    parts.out.shadows.mapSize = ShadowPlan::enoughFor(_pixels, small ? _mapSize / 2 : _mapSize);
    for (size_t i = 0; i < _sources.size(); ++i)
        add(i, samplesOf(_sources[i], pooled), maxTaken, maximum, parts);
    takeEmitters(emitterSamples, maximum, parts.out,
                 emitterSamples >= every ? parts.pool : parts.shared);
    parts.out.many = pooled == maxPooled;
    return parts.join();
}

SampledLights PreviewSampler::sampleFirst(int maximum) const {
    maximum = std::min(maximum, int(ShadowPlan::maxSmallMaps));
    int lights = 0, single = 0, pooled = 0; // maps for one sample of each light
    for (const Source& s : _sources) {
        const bool dome = s.kind == Source::Dome;
        const int samples = samplesOf(s, maxPooled), maps = dome ? 0 : mapsOf(s, _bounds);
        lights += samples + (dome ? maxPeaks : 0) + 1;
        single += maps;
        if (samples > 1) pooled += maps;
    }
    const int emitterMaps = _emitters.empty() || !_lights.castShadows() ? 0 : 6 * minEmitterSamples;
    if (_lights.pixelsChoose() || _bounds.hasFibres() || lights > maxTaken - minEmitterSamples ||
        single + emitterMaps > std::max(maximum, int(ShadowPlan::maxMaps)))
        return {};
    // Lights that are sharp have one sample, and its maps.
    const int mapped = pooled > 0 ? std::clamp((maximum - emitterMaps - (single - pooled)) / pooled,
                                               1, maxPooled / 2)
                                  : 1;
    const bool small = emitterMaps + single - pooled + mapped * pooled > ShadowPlan::maxMaps;
    Parts parts;
    parts.out.shadows.mapSize = ShadowPlan::enoughFor(_pixels, small ? _mapSize / 2 : _mapSize);
    for (size_t i = 0; i < _sources.size(); ++i)
        add(i, samplesOf(_sources[i], maxPooled), _sources[i].kind == Source::Dome ? 0 : mapped,
            ShadowPlan::maxSmallMaps, parts);
    takeEmitters(_emitters.empty() ? 0 : minEmitterSamples, ShadowPlan::maxSmallMaps, parts.out,
                 parts.shared);
    return parts.join();
}

bool PreviewPasses::resize(const GlTexture& color, const GlTexture& depth) {
    const auto make = [&](GLenum format) {
        return GlTexture(GL_TEXTURE_2D, format, color.width(), color.height());
    };
    _noisy = make(GL_RGBA32F);
    _guide = make(GL_RGBA32F);
    _place = make(GL_RGBA32F);
    _normal = make(GL_RGBA16F);
    _difference = make(GL_RGBA32F);
    for (const GlTexture* t : {&_noisy, &_guide, &_place, &_normal})
        t->filter(GL_NEAREST);
    _target = GlFramebuffer({&color, &_noisy, &_guide, &_place, &_normal}, &depth);
    _differenceTarget = GlFramebuffer({&_difference}, &depth);
    return _target.complete() && _differenceTarget.complete();
}

void PreviewPasses::clear() const {
    const float none[4] = {0, 0, 0, 0};
    for (GLint i = 1; i <= 4; ++i)
        gl.ClearNamedFramebufferfv(_target.id(), GL_COLOR, i, none);
    gl.ClearNamedFramebufferfv(_differenceTarget.id(), GL_COLOR, 0, none);
}

void PreviewPasses::smooth() const {
    gl.Disable(GL_DEPTH_TEST);
    _noisy.bind(21);
    _guide.bind(22);
    _place.bind(23);
    _normal.bind(24);
    _differenceTarget.bind();
    _program->use();
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
    gl.Enable(GL_DEPTH_TEST);
}

void PreviewPasses::add(std::vector<vec4>& pixels, const RasterSample& sample, bool preview,
                        bool first, const int* window, GlDownload& download, Film& film) {
    if (sample.pass == 0 || sample.pass >= smoothed) _first.clear();
    if (!_first.empty()) return mixFirst(pixels, sample, window, film);
    std::vector<vec4> difference;
    if (preview) download.read(_difference, difference);
    if (!first) {
        addSplats(pixels, sample, window, film);
        return addSmoothing(difference, sample, window, film);
    }
    for (size_t i = 0; i < pixels.size(); ++i)
        pixels[i] += vec4(vec3(difference[i]), 0.0f);
    const int width = film.width(), height = film.height();
    _first.assign(size_t(width) * size_t(height), vec4(0.0f));
    _sums.assign(_first.size(), vec4(0.0f));
    takeSplats(pixels, sample, window, film, [&](int x, int y, const vec4& value) {
        _first[size_t(y) * size_t(width) + size_t(x)] = value;
        film.addColor(x, y, vec3(value), value.w);
    });
}

/// Mixes the first image with the mean of the passes after it, by less from pass to pass.
void PreviewPasses::mixFirst(std::vector<vec4>& pixels, const RasterSample& sample,
                             const int* window, Film& film) {
    const uint32_t passes = sample.pass + 1;
    const float share = shareOfFirst(passes);
    const int width = film.width();
    takeSplats(pixels, sample, window, film, [&](int x, int y, const vec4& value) {
        const size_t at = size_t(y) * size_t(width) + size_t(x);
        film.addColor(x, y, vec3(value), value.w);
        _sums[at] += value;
        const vec4 mean = _sums[at] / float(passes - 1);
        if (!std::isfinite(mean.x + mean.y + mean.z) || film.sampleCount(x, y) == 0) return;
        film.setMean(x, y, glm::mix(vec3(mean), vec3(_first[at]), share), mean.w);
    });
}

/// Brings the film's share of what smoothing does to that of one pass more.
/// @param difference that smoothing makes to the pass, if any; overwritten
void PreviewPasses::addSmoothing(std::vector<vec4>& difference, const RasterSample& sample,
                                 const int* window, Film& film) {
    const int width = film.width(), height = film.height();
    if (sample.pass == 0) _smoothing.assign(size_t(width) * size_t(height), vec4(0.0f));
    if (sample.pass >= smoothed || _smoothing.empty()) return;
    const std::vector<vec4> before = _smoothing;
    if (!difference.empty())
        takeSplats(difference, sample, window, film, [&](int x, int y, const vec4& value) {
            if (std::isfinite(value.x + value.y + value.z))
                _smoothing[size_t(y) * size_t(width) + size_t(x)] += value;
        });
    const float was = share(sample.pass), is = share(sample.pass + 1);
    parallelFor(window[1], std::max(window[1], window[3] + 1), [&](int y) {
        for (int x = window[0]; x <= window[2]; ++x) {
            const size_t at = size_t(y) * size_t(width) + size_t(x);
            const vec3 change = vec3(_smoothing[at]) * is - vec3(before[at]) * was;
            if (change == vec3(0.0f) || film.sampleCount(x, y) == 0) continue;
            const vec3 mean = film.color(x, y) + change / float(film.sampleCount(x, y));
            const float least = film.allowsNegative() ? -INFINITY : 0.0f;
            film.setMean(x, y, glm::max(mean, vec3(least)), film.alpha(x, y));
        }
    });
}

} // namespace patina
