// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightSet.h"

#include "hdDelegate/lights/sphericalTriangle.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

LightSet::LightSet(LightSetInput input, LightImages& images, Diagnostics& diagnostics)
    : _input(std::move(input)), _lightCount(int(_input.lights.size())) {
    std::vector<LightTreeLeaf> leaves;
    _emitters.resize(_input.lights.size());
    LightFiles files;
    const Light* ofFiles = nullptr; // places of a light follow each other
    for (int i = 0; i < _lightCount; ++i) {
        const LightInstance& instance = _input.lights[i];
        if (!instance.light) continue;
        if (instance.light.get() != ofFiles) files = LightFiles();
        ofFiles = instance.light.get();
        const dvec3 origin = instance.light->group.empty() ? _input.origin : dvec3(0.0);
        _emitters[i] =
            LightEmitter(instance.light, instance.groupToWorld, origin, _input.shutterOpen,
                         _input.shutterClose, files, images, diagnostics);
        const LightEmitter& emitter = _emitters[i];
        if (emitter.kind() == LightEmitter::Kind::None) continue;
        if (emitter.atInfinity()) {
            _infinite.push_back(i);
            if (!emitter.delta()) _visibleInfinite.push_back(i);
            continue;
        }
        leaves.push_back(emitter.leaf(i));
        _hasIntersectable = _hasIntersectable || leaves.back().hittable;
    }
    std::map<const void*, int> known;
    _glows.reserve(_input.glowing.size());
    for (const LightTrianglePlace& place : _input.glowing)
        addPlace(place, known, leaves);
    _tree = LightTree(leaves);
}

void LightSet::addPlace(const LightTrianglePlace& place, std::map<const void*, int>& known,
                        std::vector<LightTreeLeaf>& leaves) {
    const std::vector<LightTriangle>& triangles = *place.triangles;
    Glow glow;
    if (!_glows.empty()) {
        const size_t last = _glows.size() - 1;
        const int count = int(_input.glowing[last].triangles->size());
        glow.id = _glows[last].id + (_glows[last].tree < 0 ? count : 1);
    }
    const int id = _lightCount + glow.id;
    if (!place.shared) {
        for (size_t t = 0; t < triangles.size(); ++t)
            addTriangle(triangles[t], id + int(t), leaves);
        _glows.push_back(glow);
        return;
    }
    const auto [found, isNew] = known.emplace(place.triangles.get(), int(_shared.size()));
    if (isNew) {
        std::vector<LightTreeLeaf> own;
        for (size_t t = 0; t < triangles.size(); ++t)
            addTriangle(triangles[t], int(t), own);
        _shared.emplace_back(own);
    }
    glow.tree = found->second;
    glow.toLocal = glm::inverse(place.toWorld);
    glow.normalToLocal = glm::transpose(mat3(place.toWorld));
    _glows.push_back(glow);
    const LightTree& tree = _shared[size_t(glow.tree)];
    if (tree.empty()) return;

    LightTreeLeaf leaf = tree.asLeaf();
    leaf.id = id;
    const vec3 box[2] = {leaf.low, leaf.high};
    leaf.low = vec3(INFINITY);
    leaf.high = vec3(-INFINITY);
    for (int corner = 0; corner < 8; ++corner) {
        const vec3 p(box[corner & 1].x, box[corner >> 1 & 1].y, box[corner >> 2].z);
        const vec3 w = vec3(place.toWorld * vec4(p, 1.0f));
        leaf.low = glm::min(leaf.low, w);
        leaf.high = glm::max(leaf.high, w);
    }
    // Areas as vectors go by the cofactors.
    const mat3 m(place.toWorld);
    const mat3 areas(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    double power = 0.0;
    for (const LightTriangle& t : triangles) {
        const float area = 0.5f * glm::length(areas * glm::cross(t.vertices[1] - t.vertices[0],
                                                                 t.vertices[2] - t.vertices[0]));
        if (std::isfinite(t.luminance * area)) power += double(t.luminance * area);
    }
    leaf.intensity = float(power) * place.factor;
    // A turn and an even scale keep angles; others may spread normals anywhere.
    const mat3 square = glm::transpose(areas) * areas;
    const float scale = (square[0][0] + square[1][1] + square[2][2]) / 3.0f;
    float uneven = 0.0f;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            uneven = std::max(uneven, std::abs(square[c][r] - (c == r ? scale : 0.0f)));
    const vec3 axis = areas * leaf.axis;
    leaf.axis = glm::length(axis) > 0.0f ? glm::normalize(axis) : vec3(0.0f, 0.0f, 1.0f);
    leaf.spread = uneven < 1e-4f * scale ? std::min(leaf.spread + 1e-3f, pi) : pi;
    if (leaf.intensity > 0.0f && std::isfinite(leaf.intensity)) leaves.push_back(leaf);
}

bool LightSet::addTriangle(const LightTriangle& t, int id, std::vector<LightTreeLeaf>& leaves) {
    const vec3 n = glm::cross(t.vertices[1] - t.vertices[0], t.vertices[2] - t.vertices[0]);
    const float length = glm::length(n);
    if (!(length > 0.0f) || !std::isfinite(length) || !(t.luminance > 0.0f) ||
        !std::isfinite(t.luminance))
        return false;
    LightTreeLeaf leaf;
    leaf.id = id;
    leaf.low = glm::min(t.vertices[0], glm::min(t.vertices[1], t.vertices[2]));
    leaf.high = glm::max(t.vertices[0], glm::max(t.vertices[1], t.vertices[2]));
    leaf.axis = n / length;
    leaf.intensity = t.luminance * 0.5f * length;
    leaf.twoSided = t.twoSided;
    leaves.push_back(leaf);
    return true;
}

LightSet::Located LightSet::located(const Glow& glow, const vec3& point, const vec3& normal) {
    const vec3 n = glow.normalToLocal * normal;
    const float length = glm::length(n);
    return {vec3(glow.toLocal * vec4(point, 1.0f)), length > 0.0f ? n / length : vec3(0.0f)};
}

LightTriangle LightSet::triangleInWorld(int triangle) const {
    const LightTrianglePlace& place = _input.glowing[size_t(placeOf(triangle))];
    LightTriangle t = (*place.triangles)[size_t(triangle - place.first)];
    if (place.shared)
        for (vec3& vertex : t.vertices)
            vertex = vec3(place.toWorld * vec4(vertex, 1.0f));
    return t;
}

/// @returns a light, or -1
int LightSet::chooseInTree(const vec3& point, const vec3& normal, bool twoSided, float u,
                           float& probability) const {
    const int id = _tree.choose(point, normal, twoSided, u, probability);
    if (id < _lightCount) return id;
    const int i = indexBelow(id - _lightCount, [this](size_t place) { return _glows[place].id; });
    const Glow& glow = _glows[size_t(i)];
    int triangle = id - _lightCount - glow.id;
    if (glow.tree >= 0) {
        const Located at = located(glow, point, normal);
        float below;
        triangle = _shared[size_t(glow.tree)].choose(at.point, at.normal, twoSided, u, below);
        if (triangle < 0) return -1;
        probability *= below;
    }
    return _lightCount + _input.glowing[size_t(i)].first + triangle;
}

float LightSet::probabilityInTree(int light, const vec3& point, const vec3& normal,
                                  bool twoSided) const {
    if (light < _lightCount) return _tree.probability(light, point, normal, twoSided);
    const int i = placeOf(light - _lightCount);
    const Glow& glow = _glows[size_t(i)];
    const int triangle = light - _lightCount - _input.glowing[size_t(i)].first;
    const int id = _lightCount + glow.id;
    if (glow.tree < 0) return _tree.probability(id + triangle, point, normal, twoSided);
    const Located at = located(glow, point, normal);
    const float below =
        _shared[size_t(glow.tree)].probability(triangle, at.point, at.normal, twoSided);
    return below > 0.0f ? below * _tree.probability(id, point, normal, twoSided) : 0.0f;
}

/// The weights among lights at infinity and the tree, for one point. Half of the choice follows the
/// estimates of irradiance; the other half is even, as the estimates know nothing of occlusion.
LightSet::Choice LightSet::makeChoice(const vec3& point, const vec3& normal, bool twoSided) const {
    Choice c;
    c.tree = _tree.importance(point, normal, twoSided);
    c.total = c.tree;
    c.count = c.tree > 0.0f ? 1 : 0;
    for (int light : _infinite)
        if (_emitters[light].reaches(normal, twoSided)) {
            c.total += _emitters[light].irradiance();
            ++c.count;
        }
    return c;
}

float LightSet::share(const Choice& choice, float weight) const {
    if (!std::isfinite(choice.total)) return 1.0f / float(choice.count);
    return 0.5f / float(choice.count) + 0.5f * weight / choice.total;
}

LightDraw LightSet::begin(const vec3& point, const vec3& normal, bool twoSided, const vec3& u,
                          float time) const {
    LightDraw draw;
    const Choice choice = makeChoice(point, normal, twoSided);
    if (choice.count == 0) return draw;
    float chosen = std::min(u.z, 0x1.fffffep-1f), selection = 0.0f;
    int light = -1;
    for (int candidate : _infinite) {
        if (!_emitters[candidate].reaches(normal, twoSided)) continue;
        // Without a tree the last candidate stays when rounding runs past the end.
        light = candidate;
        selection = share(choice, _emitters[candidate].irradiance());
        if (chosen < selection) break;
        chosen -= selection;
        if (choice.tree > 0.0f) light = -1;
    }
    const bool inTree = light < 0;
    if (inTree) {
        const float p = share(choice, choice.tree);
        float below;
        light = chooseInTree(point, normal, twoSided, std::min(chosen / p, 0x1.fffffep-1f), below);
        selection = p * below;
        if (light < 0 || !(selection > 0.0f)) return draw;
    }
    draw.light = light;
    draw.selection = selection;
    draw.emitter.u = vec2(u);
    if (inTree && light < _lightCount)
        _emitters[light].request();
    else if (!inTree)
        draw.emitter = _emitters[light].begin(point, normal, twoSided, vec2(u), time);
    return draw;
}

bool LightSet::sample(const LightDraw& draw, const vec3& point, const vec3& normal, bool twoSided,
                      float time, LightSample& out) const {
    const int light = draw.light;
    if (light < 0) return false;
    out.light = light;
    out.triangle = -1;
    if (light >= _lightCount)
        return sampleTriangleLight(light - _lightCount, point, draw.emitter.u, draw.selection, out);
    EmitterSample s;
    if (!_emitters[light].sample(draw.emitter, point, normal, twoSided, time, s)) return false;
    out.direction = s.direction;
    out.distance = s.distance;
    out.radiance = s.radiance;
    out.pdf = s.pdf * draw.selection;
    out.delta = _emitters[light].delta();
    out.normal = s.normal;
    out.local = s.local;
    return out.pdf > 0.0f && std::isfinite(out.pdf);
}

bool LightSet::sample(const vec3& point, const vec3& normal, bool twoSided, const vec3& u,
                      float time, LightSample& out) const {
    if (!sample(begin(point, normal, twoSided, u, time), point, normal, twoSided, time, out))
        return false;
    out.radiance *= image(out);
    return true;
}

bool LightSet::sampleTriangleLight(int triangle, const vec3& point, const vec2& u, float selection,
                                   LightSample& out) const {
    const LightTriangle t = triangleInWorld(triangle);
    TriangleSample s;
    if (!sampleTriangle(t.vertices, t.twoSided, point, u, s)) return false;
    const vec3 v = s.position - point;
    out.distance = glm::length(v);
    if (!(out.distance > 0.0f)) return false;
    out.direction = v / out.distance;
    out.radiance = vec3(1.0f);
    out.pdf = s.pdf * selection;
    out.delta = false;
    out.normal = s.normal;
    out.triangle = triangle;
    out.barycentrics = s.barycentrics;
    return out.pdf > 0.0f && std::isfinite(out.pdf);
}

int LightSet::intersect(const vec3& origin, const vec3& direction, float near, float far,
                        float time, LightHit* hits, int maxHits) const {
    int count = 0;
    if (!_hasIntersectable || maxHits < 1) return 0;
    _tree.visitRay(origin, direction, near, far, [&](int light) {
        LightHit hit;
        if (light >= _lightCount || !_emitters[light].intersect(origin, direction, near, far, time,
                                                                hit.distance, hit.normal))
            return;
        hit.light = light;
        hit.position = origin + hit.distance * direction;
        hit.radiance = _emitters[light].radiance(hit.position, -direction, time);
        if (count < maxHits) {
            hits[count++] = hit;
            return;
        }
        LightHit* farthest =
            std::max_element(hits, hits + count, [](const LightHit& a, const LightHit& b) {
                return a.distance < b.distance;
            });
        if (hit.distance < farthest->distance) *farthest = hit;
    });
    return count;
}

float LightSet::selectionProbability(int light, const vec3& point, const vec3& normal,
                                     bool twoSided) const {
    if (light < 0) return 0.0f;
    const Choice choice = makeChoice(point, normal, twoSided);
    if (choice.count == 0) return 0.0f;
    if (light < _lightCount && _emitters[light].kind() == LightEmitter::Kind::None) return 0.0f;
    if (light < _lightCount && _emitters[light].atInfinity())
        return _emitters[light].reaches(normal, twoSided)
                   ? share(choice, _emitters[light].irradiance())
                   : 0.0f;
    if (!(choice.tree > 0.0f)) return 0.0f;
    return share(choice, choice.tree) * probabilityInTree(light, point, normal, twoSided);
}

float LightSet::pdf(int light, const vec3& point, const vec3& normal, bool twoSided, float time,
                    const LightHit& hit) const {
    if (light < 0 || light >= _lightCount) return 0.0f;
    const float shape = _emitters[light].pdf(point, hit.position, hit.normal, time);
    return shape > 0.0f ? shape * selectionProbability(light, point, normal, twoSided) : 0.0f;
}

float LightSet::pdfInfinite(int light, const vec3& point, const vec3& normal, bool twoSided,
                            const EnvironmentMap::Place& place, float time) const {
    if (light < 0 || light >= _lightCount) return 0.0f;
    const float p = _emitters[light].environmentPdf(point, normal, twoSided, place, time);
    return p > 0.0f ? p * selectionProbability(light, point, normal, twoSided) : 0.0f;
}

float LightSet::pdfTriangle(int triangle, const vec3& point, const vec3& normal, bool twoSided,
                            const vec3& position) const {
    if (triangle < 0 || triangle >= _input.triangleCount) return 0.0f;
    const LightTriangle t = triangleInWorld(triangle);
    const float p = trianglePdf(t.vertices, t.twoSided, point, position);
    return p > 0.0f && std::isfinite(p)
               ? p * selectionProbability(_lightCount + triangle, point, normal, twoSided)
               : 0.0f;
}

vec3 LightSet::environment(int light, const EnvironmentMap::Place& place, float time) const {
    return light >= 0 && light < _lightCount ? _emitters[light].environment(place, time)
                                             : vec3(0.0f);
}

vec3 LightSet::environment(const vec3& direction, float time) const {
    vec3 sum(0.0f);
    for (int light : _visibleInfinite)
        sum += _emitters[light].environment(_emitters[light].place(direction, time), time);
    return sum;
}

} // namespace patina
