// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/glowingSurfaces.h"

#include "hdDelegate/embree/caustics/causticCasters.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace patina {

namespace {

/// What may be brighter elsewhere is not left out.
constexpr float leastLuminance = 1e-6f, leastFactor = 1e-6f;
/// Triangles that instances give to one light tree; of more than that the instances share a tree.
constexpr size_t mostOfOneTree = 1024;

LightTriangle triangleAt(const Surface& surface, unsigned primitive, const mat4& place) {
    LightTriangle triangle;
    const uvec3& corners = surface.topology().triangles[primitive];
    for (int k = 0; k < 3; ++k)
        triangle.vertices[k] = vec3(place * vec4(surface.placed.positions[0][corners[k]], 1.0f));
    return triangle;
}

/// An order of places, by the instances that they are inside of.
bool standBefore(const InstanceStep* a, size_t countA, const InstanceStep* b, size_t countB) {
    return std::lexicographical_compare(
        a, a + countA, b, b + countB, [](const InstanceStep& x, const InstanceStep& y) {
            const Instancer *of = &x.values->instancer(), *other = &y.values->instancer();
            return of == other ? x.instance < y.instance : std::less<>()(of, other);
        });
}

/// Whether points go there and back without loss.
bool isEvenEnough(const mat4& place) {
    const mat4 back = glm::inverse(place);
    float there = 0.0f, inverse = 0.0f;
    for (int c = 0; c < 3; ++c) {
        there = std::max(there, glm::length(vec3(place[c])));
        inverse = std::max(inverse, glm::length(vec3(back[c])));
    }
    return there * inverse < 1e3f && std::isfinite(glm::dot(back[3], back[3]));
}

LightTriangles trianglesOf(const Surface& surface, const std::vector<unsigned>& primitives,
                           const std::vector<float>& luminances, const mat4& place,
                           bool bothSides) {
    auto made = std::make_shared<std::vector<LightTriangle>>();
    made->reserve(primitives.size());
    for (size_t slot = 0; slot < primitives.size(); ++slot) {
        const unsigned t = primitives[slot];
        LightTriangle triangle = triangleAt(surface, t, place);
        triangle.twoSided = surface.material(t).program->hasEmission() || bothSides;
        triangle.luminance = luminances[slot];
        made->push_back(triangle);
    }
    return made;
}

using EmissionHere = std::function<vec3(const SurfacePoint&)>;

/// The largest luminance of a triangle at a few points.
float brightestOf(const Surface& surface, unsigned primitive, const GroupPlace& where,
                  bool mirrored, const EmissionHere& emission) {
    const LightTriangle triangle = triangleAt(surface, primitive, where.toWorld);
    const vec3 ng = glm::cross(triangle.vertices[1] - triangle.vertices[0],
                               triangle.vertices[2] - triangle.vertices[0]);
    const float length = glm::length(ng);
    if (!(length > 0.0f)) return 0.0f;
    const vec3 n = ng / length * (mirrored ? -1.0f : 1.0f);
    const bool glows = surface.material(primitive).program->hasEmission();
    float brightest = 0.0f;
    for (const vec2 uv : {vec2(1 / 3.0f), vec2(0.1f), vec2(0.8f, 0.1f), vec2(0.1f, 0.8f)}) {
        const Hit hit = hitOn(&surface, primitive, where, uv);
        SurfacePoint point;
        const vec3 p = triangle.vertices[0] * (1 - uv.x - uv.y) + triangle.vertices[1] * uv.x +
                       triangle.vertices[2] * uv.y;
        // Each side may have a shader of its own.
        for (const float side : {1.0f, -1.0f}) {
            computeSurfacePoint(hit, p + n * side, -n * side, 0.0f, point);
            brightest = std::max(brightest, luminance(glm::abs(emission(point))));
            if (!glows) break;
        }
    }
    return brightest;
}

/// How much brighter a surface is at a place than its luminances say, by a few of its triangles:
/// the brightest, and others evenly spread.
float factorOf(const Surface& surface, const std::vector<unsigned>& primitives,
               const std::vector<float>& luminances, const GroupPlace& where, bool mirrored,
               bool alike, const EmissionHere& emission) {
    constexpr size_t asked = 3;
    float here = 0.0f, first = 0.0f;
    const auto ask = [&](size_t slot) {
        here += brightestOf(surface, primitives[slot], where, mirrored, emission);
        first += luminances[slot];
    };
    alike = alike && std::all_of(primitives.begin(), primitives.end(), [&](unsigned t) {
                return surface.material(t).program->constant();
            });
    if (alike) return 1.0f;
    ask(size_t(std::max_element(luminances.begin(), luminances.end()) - luminances.begin()));
    for (size_t i = 0; i < asked; ++i)
        ask(i * luminances.size() / asked);
    return std::max(here / first, leastFactor);
}

} // namespace

void GlowingSurfaces::add(const Surface& surface, std::vector<GroupPlace> places, int info,
                          bool isMeshLight, bool alike, const Emission& emission,
                          LightSetInput& input) {
    const std::vector<uvec3>& triangles = surface.topology().triangles;
    if (places.empty()) return;
    const auto emissionAt = [&](size_t place) -> EmissionHere {
        return [&emission, place](const SurfacePoint& point) { return emission(point, place); };
    };
    const auto volume = [](const GroupPlace& where) {
        return glm::determinant(mat3(where.toWorld));
    };
    // One-sided triangles shine along their winding; a mirroring transform turned it.
    const auto isMirrored = [&](const GroupPlace& where) {
        return surface.flipNormals != (volume(where) < 0.0f);
    };
    // Where it is largest; it may be flat elsewhere.
    const size_t seenAt =
        size_t(std::max_element(places.begin(), places.end(),
                                [&](const GroupPlace& a, const GroupPlace& b) {
                                    return std::abs(volume(a)) < std::abs(volume(b));
                                }) -
               places.begin());
    Emitting& found = _emitting[&surface];
    found.slots.assign(triangles.size(), -1);
    std::vector<float> luminances; // per slot
    for (unsigned t = 0; t < triangles.size(); ++t) {
        const MaterialProgram& program = *surface.material(t).program;
        if (!isMeshLight && !program.hasEmission()) continue;
        const float brightest =
            brightestOf(surface, t, places[seenAt], isMirrored(places[seenAt]), emissionAt(seenAt));
        if (!(brightest > 0.0f) && program.constant()) continue;
        found.slots[t] = int(found.primitives.size());
        found.primitives.push_back(t);
        luminances.push_back(std::max(brightest, leastLuminance));
    }
    if (found.primitives.empty()) {
        _emitting.erase(&surface);
        return;
    }
    found.firstPlace = int(input.glowing.size());
    const bool share = places.size() > 1 && places.size() * found.primitives.size() > mostOfOneTree;
    LightTriangles shared[2]; // of those that shine along their winding, and others
    for (size_t i = 0; i < places.size(); ++i) {
        const GroupPlace& where = places[i];
        const bool mirrored = isMirrored(where);
        LightTrianglePlace place;
        place.toWorld = where.toWorld;
        place.shared = share && isEvenEnough(where.toWorld);
        if (place.shared) {
            // Winding does not tell the side where space is mirrored.
            const bool bothSides = mirrored || volume(where) < 0.0f;
            LightTriangles& table = shared[bothSides];
            if (!table)
                table = trianglesOf(surface, found.primitives, luminances, mat4(1.0f), bothSides);
            place.triangles = table;
            place.factor = factorOf(surface, found.primitives, luminances, where, mirrored, alike,
                                    emissionAt(i));
        } else {
            std::vector<float> here = luminances;
            for (size_t slot = 0; i != seenAt && slot < here.size(); ++slot)
                here[slot] = std::max(
                    brightestOf(surface, found.primitives[slot], where, mirrored, emissionAt(i)),
                    leastLuminance);
            place.triangles = trianglesOf(surface, found.primitives, here, where.toWorld, mirrored);
        }
        input.add(std::move(place));
        _sources.push_back({&surface, &found, info});
        found.places.push_back(int(_places.size()));
        _places.push_back(std::move(places[i]));
    }
    std::sort(found.places.begin(), found.places.end(), [&](int a, int b) {
        const auto &x = _places[size_t(a)].steps, &y = _places[size_t(b)].steps;
        return standBefore(x.data(), x.size(), y.data(), y.size());
    });
}

int GlowingSurfaces::placeOf(const Emitting& emitting, const Hit& hit) const {
    const auto found = std::lower_bound(
        emitting.places.begin(), emitting.places.end(), hit, [&](int place, const Hit& to) {
            const std::vector<InstanceStep>& steps = _places[size_t(place)].steps;
            return standBefore(steps.data(), steps.size(), to.steps, size_t(to.stepCount));
        });
    return found == emitting.places.end() ? emitting.firstPlace : *found;
}

std::pair<int, int> GlowingSurfaces::find(const Hit& hit) const {
    const auto found = _emitting.find(hit.surface);
    if (found == _emitting.end()) return {-1, -1};
    const int slot = found->second.slots[hit.primitive];
    return {slot < 0 ? -1 : placeOf(found->second, hit), slot};
}

int GlowingSurfaces::placeFromFirst(const Hit& hit) const {
    const auto found = _emitting.find(hit.surface);
    return found == _emitting.end() ? 0 : placeOf(found->second, hit) - found->second.firstPlace;
}

Hit GlowingSurfaces::hit(int place, int triangle, const vec2& barycentrics) const {
    const Source& source = _sources[size_t(place)];
    return hitOn(source.surface, source.emitting->primitives[size_t(triangle)],
                 _places[size_t(place)], barycentrics);
}

} // namespace patina
