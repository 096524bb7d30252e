// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/samples/lightSampler.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/geometry/mortonOrder.h"
#include "hdDelegate/raster/samples/lightChoice.h"

#include <algorithm>
#include <cmath>

namespace patina {

using Source = RasterLightSource;

vec2 LightSampler::twoNumbers(uint32_t index, uint32_t set) const {
    return Sampler(set, 1, _lights.seed(), index).next2();
}

vec3 LightSampler::threeNumbers(uint32_t index, uint32_t set) const {
    return Sampler(set, 1, _lights.seed(), index).next3();
}

int LightSampler::mapsOf(const Source& s, const ShadowBounds& bounds) const {
    if (!s.shadows) return 0;
    if (s.kind == Source::Dome) return _lights.domeSamples();
    if (s.kind == Source::Distant) return 1;
    return shadowTangent(s.position, s.extent, bounds) <= ShadowView::widestTangent ? 1 : 6;
}

void LightSampler::cast(GpuLight& sample, size_t number, uint32_t index, int maximum,
                        ShadowPlan& shadows) const {
    const Source& s = _sources[number];
    if (!s.shadows) return;
    if (s.kind == Source::Dome && _lights.domeSamples() == 0)
        sample.castBySky();
    else
        shadows.cast(sample, s.shadowCategory, twoNumbers(index, setOf(number) + 1), _bounds,
                     maximum);
}

/// Lights by how many maps they need, each kind with its own share of the room.
std::vector<std::pair<size_t, float>> LightSampler::choose(int room, int emitterSamples) const {
    const bool perPixel = _lights.pixelsChoose();
    std::vector<std::pair<size_t, float>> out;
    std::vector<size_t> groups[3]; // no maps, one, six
    std::vector<size_t> domes;
    for (size_t i = 0; i < _sources.size(); ++i) {
        const int maps = mapsOf(_sources[i], _bounds);
        if (_sources[i].kind == Source::Dome)
            domes.push_back(i);
        else
            groups[maps == 0 ? 0 : maps == 1 ? 1 : 2].push_back(i);
    }
    // The light of domes shows everywhere: up to `maxDomes` none is ever missing.
    const float turn = twoNumbers(_pass, 23).x;
    for (const ChosenLight& c :
         chooseLights(std::vector<float>(domes.size(), 1.0f), maxDomes, turn)) {
        out.emplace_back(domes[c.index], c.share);
        room -= mapsOf(_sources[domes[c.index]], _bounds);
    }
    room = std::max(room, 7);
    const int others = int(out.size()) * std::max(_lights.domeSamples(), 1) +
                       (perPixel ? emitterSamples : int(RasterEmitters::maxSamples));
    const int left = std::max(maxTaken - others, 3);
    const int ones = int(groups[1].size()), sixes = int(groups[2].size());
    const int forSixes = std::min(sixes, std::max(1, (room - std::min(ones, room / 4)) / 6));
    int maximum[3] = {perPixel ? int(maxTaken) : int(maxUnshadowed),
                      sixes > 0 ? room - 6 * forSixes : room, forSixes};
    for (int k = 0, given = left; k < 3; ++k) { // a third each at least
        const int wanted = std::min(maximum[k], int(groups[k].size()));
        int later = 0; // that the others have no use for
        for (int j = k + 1; perPixel && j < 3; ++j)
            later += std::min(maximum[j], int(groups[j].size()));
        const int share = perPixel ? std::max(given / (3 - k), given - later) : given / (3 - k);
        maximum[k] = std::min(wanted, share);
        given -= maximum[k];
    }
    const vec3 center = 0.5f * (_bounds.receiverMin + _bounds.receiverMax);
    const float radius = 0.25f * glm::length(_bounds.receiverMax - _bounds.receiverMin);
    for (int k = 0; k < 3; ++k) {
        std::vector<float> weights;
        float sum = 0.0f;
        for (size_t i : groups[k]) {
            const Source& s = _sources[i];
            const float d = std::max(glm::length(s.position - center), radius);
            weights.push_back(s.kind == Source::Distant ? s.weight
                                                        : s.weight / std::max(d * d, 1e-20f));
            sum += weights.back();
        }
        // A light that does little to the whole may do much to what is near.
        for (float& w : weights)
            w = 1.0f / float(weights.size()) + (sum > 0.0f && std::isfinite(sum) ? w / sum : 0.0f);
        const float u = twoNumbers(_pass, 20 + uint32_t(k)).x;
        for (const ChosenLight& c : chooseLights(weights, size_t(std::max(maximum[k], 0)), u))
            out.emplace_back(groups[k][c.index], c.share);
    }
    return out;
}

SampledLights LightSampler::sample(int most) const {
    const bool perPixel = _lights.pixelsChoose();
    SampledLights out;
    ShadowPlan& maps = out.shadows;
    int wanted = 0;
    for (const Source& s : _sources)
        wanted += mapsOf(s, _bounds);
    if (_bounds.hasFibres()) {
        int more = 0;
        for (const Source& s : _sources)
            more += mapsOf(s, _bounds.ofFibres());
        maps.fibres =
            wanted + more + (_emitters.empty() ? 0 : 6 * minEmitterSamples) <= ShadowPlan::maxMaps;
        if (maps.fibres) wanted += more;
    }
    // Maps of half the size are still finer than a small image, and more samples gain more.
    const bool coarse = _mapSize / 2 >= 4 * _pixels;
    const int emitterSamples =
        _emitters.empty()
            ? 0
            : std::clamp(((coarse ? ShadowPlan::maxSmallMaps : ShadowPlan::maxMaps) - wanted) / 6,
                         minEmitterSamples,
                         coarse ? RasterEmitters::maxSamples : maxEmitterSamples);
    const int forEmitters = _lights.castShadows() ? 6 * emitterSamples : 0;
    wanted += forEmitters;
    int maximum = ShadowPlan::maxMaps;
    maps.mapSize = _mapSize;
    if (wanted > ShadowPlan::maxMaps) {
        maximum = ShadowPlan::maxSmallMaps;
        maps.mapSize = _mapSize / 2;
    }
    // As many texels in more maps, as long as they are no coarser than the image.
    while (wanted > maximum && maximum < ShadowPlan::maxTinyMaps && maps.mapSize / 2 >= _pixels) {
        maximum *= 4;
        maps.mapSize /= 2;
    }
    // A pixel that takes few of the lights needs the shadows of all. The maps have as many texels
    // all together as where lights are fewer.
    if (perPixel && wanted > maximum && most > maximum) {
        const float texels = float(_mapSize) * float(_mapSize) * float(ShadowPlan::maxMaps);
        maximum = std::min(most, int(ShadowPlan::maxManyMaps));
        const int side = int(std::sqrt(texels / float(std::min(wanted, maximum)))) / 32 * 32;
        maps.mapSize = std::clamp(side, int(ShadowPlan::leastManyMap), maps.mapSize);
    }
    maps.mapSize = ShadowPlan::enoughFor(_pixels, maps.mapSize);
    int room = maximum - forEmitters;
    std::vector<bool> taken(_sources.size(), false);
    std::vector<std::pair<GpuLight, size_t>> placed; // with the sources
    for (const auto& [number, count] : choose(room, emitterSamples)) {
        const Source& s = _sources[number];
        taken[number] = true;
        const int samples = s.kind == Source::Dome ? std::max(_lights.domeSamples(), 1) : 1;
        for (int n = 0; n < samples; ++n) {
            const uint32_t index = _pass * uint32_t(samples) + uint32_t(n);
            GpuLight g = s.sample(threeNumbers(index, setOf(number)));
            g.weight = count;
            // The first of a dome also stands for what samples of the BSDF find.
            if (n > 0) g.kind = shLights::LIGHT_MORE_DOME;
            cast(g, number, index, room, maps);
            if (perPixel && s.atPlace())
                placed.emplace_back(g, number);
            else
                out.lights.push_back(g);
        }
    }
    takeEmitters(emitterSamples, maximum, out, out.lights);
    out.firstShared = int(out.lights.size());
    if (perPixel) choosePerPixel(placed, out);
    if (out.lights.size() > size_t(maxTaken)) out.lights.resize(size_t(maxTaken));
    out.taken = int(out.lights.size());
    out.found = out.taken;
    if (!perPixel) out.firstShared = out.taken;
    for (size_t i = 0; i < _sources.size(); ++i)
        if (!taken[i] && _sources[i].fixed.is(shLights::LIGHT_IS_SEEN))
            out.lights.push_back(_sources[i].sample(vec3(0.5f)));
    return out;
}

void LightSampler::choosePerPixel(const std::vector<std::pair<GpuLight, size_t>>& placed,
                                  SampledLights& out) const {
    // Neighbours in the list are neighbours in space, so that what is chosen is spread over it.
    std::vector<vec3> places;
    for (const auto& [light, source] : placed)
        places.push_back(_sources[source].position);
    out.estimates.resize(out.lights.size());
    for (const uint32_t i : mortonOrder(places)) {
        if (out.lights.size() == size_t(maxTaken)) break;
        out.lights.push_back(placed[i].first);
        out.estimates.push_back(_sources[placed[i].second].estimate);
        out.estimates.back().power *= placed[i].first.weight;
    }
}

void LightSampler::takeEmitters(int samples, int maximum, SampledLights& out,
                                std::vector<GpuLight>& to) const {
    for (uint32_t n = 0; n < uint32_t(samples); ++n) {
        const vec2 u = twoNumbers(_pass * uint32_t(samples) + n, 17);
        const vec2 turn = twoNumbers(_pass * uint32_t(samples) + n, 18);
        float within, chance;
        const RasterEmitter& e = _emitters.choose(u.x, within, chance);
        // Uniform over the triangle (Turk 1990).
        const float root = std::sqrt(within);
        GpuLight g;
        g.samplePlace(e.corner + e.edge1 * (root * (1.0f - u.y)) + e.edge2 * (root * u.y));
        g.normal = glm::normalize(glm::cross(e.edge1, e.edge2));
        g.density = chance / e.area;
        if (e.mirrored) g.normal = -g.normal;
        const RasterEmission glow = _emitters.emission(e, vec2(root * (1.0f - u.y), root * u.y));
        g.kind = shLights::LIGHT_TRIANGLE;
        g.radiance = glow.radiance;
        if (!glow.values.empty()) {
            g.radiance = vec3(1.0f);
            g.firstValue = _lights.tables().firstOfPass() + int(out.tables.size());
            g.columns = glow.stepsOfTheta;
            g.rows = glow.stepsOfTurn;
            g.shapingAxis = glow.axis;
            g.shapingX = glow.x;
            g.shapingY = glow.y;
            for (const vec3& value : glow.values)
                out.tables.emplace_back(value, 0.0f);
        }
        g.axis0 = e.edge1;
        g.axis1 = e.edge2;
        g.set(shLights::LIGHT_TWO_SIDED, e.twoSided);
        g.weight = 1.0f / float(samples);
        g.category = e.category;
        if (e.filtered) g.setFilters(_lights.filters().ofMesh(*e.filtered, e.place));
        if (_lights.castShadows()) out.shadows.cast(g, -1, turn, _bounds, maximum);
        to.push_back(g);
    }
}

} // namespace patina
