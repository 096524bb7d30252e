// SPDX-License-Identifier: Apache-2.0
// The samples that a pass takes of the lights.

#include "base/maths.h"
#include "hdDelegate/raster/lights/lightChoice.h"
#include "hdDelegate/raster/lights/rasterLights.h"
#include "hdDelegate/raster/passes/passNumbers.h"
#include "hdDelegate/raster/shadows/rasterCulling.h"
#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

GpuLight RasterLights::draw(const Source& s, const vec3& u) const {
    GpuLight g = s.fixed;
    vec3 radiance = s.radiance;
    switch (s.kind) {
    default: { // shapes
        if (s.shape.kind == AreaShape::Kind::Sphere) {
            g.samplePlace(s.shape.origin + s.shape.axes * shLights::sphereLightPlace(u));
            break;
        }
        vec3 q = shLights::shapePlace(s.kind, vec2(u));
        float image = 1.0f;
        if (s.image) { // shaders look the image up
            vec2 on;
            image = s.image->sample(vec2(u), on);
            q = vec3(on, 0.0f);
        }
        g.samplePlace(s.shape.origin + s.shape.axes * q);
        g.normal = shapeNormalAt(s.kind, s.shape, q);
        g.density = image * shapePlaceDensity(s.kind, s.shape, q);
        break;
    }
    case Triangle: break; // see takeEmitters()
    case Point: g.samplePlace(s.position); break;
    case Line: g.samplePlace(s.position + (u.x - 0.5f) * s.toLight); break;
    case Distant: {
        const vec3 helper = std::fabs(s.toLight.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 1, 0);
        const vec3 x = glm::normalize(glm::cross(helper, s.toLight));
        const vec3 direction =
            shLights::distantSample({x, glm::cross(s.toLight, x), s.toLight}, g.versine, vec2(u));
        g.sampleDirection(direction, s.delta ? 1.0f : 1.0f / (2.0f * pi * g.versine));
        break;
    }
    case Dome:
    case MoreDome: {
        vec3 d;
        float pdf = 0.25f / pi;
        if (s.environment) {
            d = s.environment->sample(vec2(u), pdf);
            radiance *= s.environment->radiance(d);
        } else {
            d = shLights::spherePlace(vec2(u));
        }
        g.sampleDirection(s.domeToWorld * d, pdf);
        if (!(pdf > 0.0f)) radiance = vec3(0.0f), g.density = 1.0f;
        break;
    }
    }
    g.radiance = radiance;
    g.kind = s.kind;
    return g;
}

/// Small images gain nothing from finer maps, and drawing these is most of a pass there.
int RasterLights::enoughFor(int pixels, int mapSize) {
    while (mapSize / 2 >= std::max(texelsPerPixel * pixels, int(smallestMap)))
        mapSize /= 2;
    return mapSize;
}

/// The shadow maps that samples of a light need at most; see castShadow().
int RasterLights::mapsOf(const Source& s, const ShadowBounds& bounds) const {
    if (!_shadows || !s.shadows) return 0;
    if (s.kind == Dome) return _domeSamples;
    if (s.kind == Distant) return 1;
    return shadowTangent(s.position, s.extent, bounds) <= ShadowView::widestTangent ? 1 : 6;
}

/// Lights by how many maps they need, each kind with its own share of the room.
/// @returns index of the source and how often it counts
std::vector<std::pair<size_t, float>> RasterLights::choose(uint32_t pass,
                                                           const ShadowBounds& bounds, int room,
                                                           int emitterSamples) const {
    std::vector<std::pair<size_t, float>> out;
    std::vector<size_t> groups[3]; // no maps, one, six
    std::vector<size_t> domes;
    for (size_t i = 0; i < _sources.size(); ++i) {
        const int maps = mapsOf(_sources[i], bounds);
        if (_sources[i].kind == Dome)
            domes.push_back(i);
        else
            groups[maps == 0 ? 0 : maps == 1 ? 1 : 2].push_back(i);
    }
    // The light of domes shows everywhere: up to `maxDomes` none is ever missing.
    const float turn = passNumbers(_seed, pass, 23).x;
    for (const ChosenLight& c :
         chooseLights(std::vector<float>(domes.size(), 1.0f), maxDomes, turn)) {
        out.emplace_back(domes[c.index], c.share);
        room -= mapsOf(_sources[domes[c.index]], bounds);
    }
    room = std::max(room, 7);
    const int others = int(out.size()) * std::max(_domeSamples, 1) +
                       (_pixelsChoose ? emitterSamples : int(maxCoarseSamples));
    const int left = std::max(maxTaken - others, 3);
    const int ones = int(groups[1].size()), sixes = int(groups[2].size());
    const int forSixes = std::min(sixes, std::max(1, (room - std::min(ones, room / 4)) / 6));
    int maximum[3] = {_pixelsChoose ? int(maxTaken) : int(maxUnshadowed),
                      sixes > 0 ? room - 6 * forSixes : room, forSixes};
    for (int k = 0, given = left; k < 3; ++k) { // a third each at least
        const int wanted = std::min(maximum[k], int(groups[k].size()));
        int later = 0; // that the others have no use for
        for (int j = k + 1; _pixelsChoose && j < 3; ++j)
            later += std::min(maximum[j], int(groups[j].size()));
        const int share =
            _pixelsChoose ? std::max(given / (3 - k), given - later) : given / (3 - k);
        maximum[k] = std::min(wanted, share);
        given -= maximum[k];
    }
    const vec3 center = 0.5f * (bounds.receiverMin + bounds.receiverMax);
    const float radius = 0.25f * glm::length(bounds.receiverMax - bounds.receiverMin);
    for (int k = 0; k < 3; ++k) {
        std::vector<float> weights;
        float sum = 0.0f;
        for (size_t i : groups[k]) {
            const Source& s = _sources[i];
            const float d = std::max(glm::length(s.position - center), radius);
            weights.push_back(s.kind == Distant ? s.weight : s.weight / std::max(d * d, 1e-20f));
            sum += weights.back();
        }
        // A light that does little to the whole may do much to what is near.
        for (float& w : weights)
            w = 1.0f / float(weights.size()) + (sum > 0.0f && std::isfinite(sum) ? w / sum : 0.0f);
        const float u = passNumbers(_seed, pass, 20 + uint32_t(k)).x;
        for (const ChosenLight& c : chooseLights(weights, size_t(std::max(maximum[k], 0)), u))
            out.emplace_back(groups[k][c.index], c.share);
    }
    return out;
}

RasterLights::Sampled RasterLights::sample(uint32_t pass, const RasterEmitters& emitters,
                                           const ShadowBounds& bounds, int mapSize, int pixels,
                                           int most) const {
    Sampled out;
    int wanted = 0;
    for (const Source& s : _sources)
        wanted += mapsOf(s, bounds);
    if (bounds.hasFibres()) {
        int more = 0;
        for (const Source& s : _sources)
            more += mapsOf(s, bounds.ofFibres());
        out.fibres = wanted + more + (emitters.empty() ? 0 : 6 * minEmitterSamples) <= maxMaps;
        if (out.fibres) wanted += more;
    }
    // Maps of half the size are still finer than a small image, and more samples gain more.
    const bool coarse = mapSize / 2 >= 4 * pixels;
    const int emitterSamples =
        emitters.empty()
            ? 0
            : std::clamp(((coarse ? maxSmallMaps : maxMaps) - wanted) / 6, minEmitterSamples,
                         coarse ? maxCoarseSamples : maxEmitterSamples);
    const int forEmitters = _shadows ? 6 * emitterSamples : 0;
    wanted += forEmitters;
    int maximum = maxMaps;
    out.mapSize = mapSize;
    if (wanted > maxMaps) {
        maximum = maxSmallMaps;
        out.mapSize = mapSize / 2;
    }
    // As many texels in more maps, as long as they are no coarser than the image.
    while (wanted > maximum && maximum < maxTinyMaps && out.mapSize / 2 >= pixels) {
        maximum *= 4;
        out.mapSize /= 2;
    }
    // A pixel that takes few of the lights needs the shadows of all. The maps have as many texels
    // all together as where lights are fewer.
    if (_pixelsChoose && wanted > maximum && most > maximum) {
        const float texels = float(mapSize) * float(mapSize) * float(maxMaps);
        maximum = std::min(most, int(maxManyMaps));
        const int side = int(std::sqrt(texels / float(std::min(wanted, maximum)))) / 32 * 32;
        out.mapSize = std::clamp(side, int(leastManyMap), out.mapSize);
    }
    out.mapSize = enoughFor(pixels, out.mapSize);
    int room = maximum - forEmitters;
    std::vector<bool> taken(_sources.size(), false);
    std::vector<std::pair<GpuLight, size_t>> placed; // with the sources
    for (const auto& choice : choose(pass, bounds, room, emitterSamples)) {
        const Source& s = _sources[choice.first];
        taken[choice.first] = true;
        const uint32_t set = 100 + 16 * uint32_t(choice.first);
        const int samples = s.kind == Dome ? std::max(_domeSamples, 1) : 1;
        for (int n = 0; n < samples; ++n) {
            const uint32_t index = pass * uint32_t(samples) + uint32_t(n);
            GpuLight g = draw(s, threeNumbers(_seed, index, set));
            g.weight = choice.second;
            // The first of a dome also stands for what samples of the BSDF find.
            if (n > 0) g.kind = MoreDome;
            if (_shadows && s.shadows && s.kind == Dome && _domeSamples == 0)
                g.castBySky();
            else if (_shadows && s.shadows)
                castShadow(g, s.shadowCategory, passNumbers(_seed, index, set + 1), bounds, room,
                           out);
            if (_pixelsChoose && s.atPlace())
                placed.emplace_back(g, choice.first);
            else
                out.lights.push_back(g);
        }
    }
    takeEmitters(pass, emitterSamples, emitters, bounds, maximum, out);
    out.firstShared = int(out.lights.size());
    if (_pixelsChoose) choosePerPixel(pass, bounds, placed, out);
    if (out.lights.size() > size_t(maxTaken)) out.lights.resize(size_t(maxTaken));
    out.taken = int(out.lights.size());
    out.found = out.taken;
    if (!_pixelsChoose) out.firstShared = out.taken;
    for (size_t i = 0; i < _sources.size(); ++i)
        if (!taken[i] && _sources[i].fixed.is(shLights::LIGHT_IS_SEEN))
            out.lights.push_back(draw(_sources[i], vec3(0.5f)));
    return out;
}

void RasterLights::choosePerPixel(uint32_t pass, const ShadowBounds& bounds,
                                  const std::vector<std::pair<GpuLight, size_t>>& placed,
                                  Sampled& out) const {
    // Neighbours in the list are neighbours in space, so that what is chosen is spread over it.
    std::vector<vec3> places;
    for (const auto& [light, source] : placed)
        places.push_back(_sources[source].position);
    const size_t first = out.lights.size();
    out.estimates.resize(first);
    for (const uint32_t i : mortonOrder(places)) {
        if (out.lights.size() == size_t(maxTaken)) break;
        out.lights.push_back(placed[i].first);
        out.estimates.push_back(_sources[placed[i].second].estimate);
        out.estimates.back().power *= placed[i].first.weight;
    }
    out.cells =
        LightCells(out.estimates, first, bounds.receiverMin, bounds.receiverMax, _seed, pass);
}

void RasterLights::takeEmitters(uint32_t pass, int samples, const RasterEmitters& emitters,
                                const ShadowBounds& bounds, int maximum, Sampled& out) const {
    for (uint32_t n = 0; n < uint32_t(samples); ++n) {
        const vec2 u = passNumbers(_seed, pass * uint32_t(samples) + n, 17);
        const vec2 turn = passNumbers(_seed, pass * uint32_t(samples) + n, 18);
        float within, chance;
        const RasterEmitter& e = emitters.choose(u.x, within, chance);
        // Uniform over the triangle (Turk 1990).
        const float root = std::sqrt(within);
        GpuLight g;
        g.samplePlace(e.corner + e.edge1 * (root * (1.0f - u.y)) + e.edge2 * (root * u.y));
        g.normal = glm::normalize(glm::cross(e.edge1, e.edge2));
        g.density = chance / e.area;
        if (e.mirrored) g.normal = -g.normal;
        const RasterEmission glow = emitters.emission(e, vec2(root * (1.0f - u.y), root * u.y));
        g.kind = Triangle;
        g.radiance = glow.radiance;
        if (!glow.values.empty()) {
            g.radiance = vec3(1.0f);
            g.firstValue = _tables.firstOfPass() + int(out.tables.size());
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
        if (e.filtered) g.setFilters(_filters.ofMesh(*e.filtered, e.place));
        if (_shadows) castShadow(g, -1, turn, bounds, maximum, out);
        out.lights.push_back(g);
    }
}

} // namespace patina
