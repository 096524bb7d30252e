// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sceneLights.h"

#include "hdDelegate/embree/caustics/causticCasters.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/limits.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// World area of a surface (first time step).
double areaOf(const Surface& surface, const mat4& place) {
    double area = 0.0;
    for (const uvec3& t : surface.topology().triangles) {
        vec3 p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = vec3(place * vec4(surface.placed.positions[0][t[k]], 1.0f));
        area += 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    return area;
}

} // namespace

namespace {

/// Whether so many more lights are within Limit::lights.
bool haveRoom(double more, const LightSetInput& input) {
    const double sum = double(input.lights.size()) + double(input.triangles.size()) + more;
    return sum <= double(limitOf(Limit::lights));
}

void warnOfMany(const std::string& light, Diagnostics& diagnostics) {
    diagnostics.warn(light, "",
                     "with it the scene has more lights, each wherever it is placed, than " +
                         limitText(Limit::lights) + "; the light is off");
}

} // namespace

LightInfo SceneLights::describe(const std::shared_ptr<const Light>& light, const EmbreeScene& scene,
                                const RenderSettings& settings) {
    LightInfo info;
    info.lightCategory = info.shadowCategory = everything;
    if (!light) return info;
    info.prim = light;
    info.dome = light->type == LightType::Dome;
    info.cameraVisible = light->cameraVisible && (!info.dome || settings.domeLightCameraVisibility);
    if (!light->lightLink.empty()) info.lightCategory = scene.links().of(light->lightLink);
    if (!light->shadowLink.empty()) info.shadowCategory = scene.links().of(light->shadowLink);
    info.diffuse = light->diffuse;
    info.specular = light->specular;
    info.castsShadows = light->shadowEnable;
    info.shadowColor = light->shadowColor;
    info.shadowDistance = light->shadowDistance;
    info.shadowFalloff = light->shadowFalloff;
    info.shadowFalloffGamma = light->shadowFalloffGamma;
    _splitsLobes |= info.diffuse != 1.0f || info.specular != 1.0f;
    return info;
}

SceneLights::SceneLights(const SceneState& state, const EmbreeScene& scene, const Camera& camera,
                         const RenderSettings& settings, LightImages& images,
                         Diagnostics& diagnostics) {
    LightSetInput input;
    input.origin = scene.origin();
    input.shutterOpen = float(camera.shutterOpen);
    input.shutterClose = settings.enableMotionBlur ? float(camera.shutterClose) : input.shutterOpen;
    std::map<std::string, std::vector<mat4>> places;
    std::vector<std::shared_ptr<const Light>> meshLights;
    for (const auto& item : state.lights) {
        const auto& light = item.second;
        if (!light->visible || !settings.enableSceneLights) continue;
        if (light->type == LightType::Mesh) {
            meshLights.push_back(light);
            continue;
        }
        if (!haveRoom(scene.placeCount(light->group), input)) {
            warnOfMany(light->path, diagnostics);
            continue;
        }
        if (!places.count(light->group)) places[light->group] = scene.groupTransforms(light->group);
        for (const mat4& place : places[light->group]) {
            input.lights.push_back({light, place});
            _infos.push_back(describe(light, scene, settings));
        }
    }
    _glowInfo = int(_infos.size());
    _infos.push_back(describe(nullptr, scene, settings));
    _infos.back().triangles = true;

    for (const auto& light : meshLights) {
        const Surface* surface = scene.surfaceOf(light->geometry).get();
        if (!surface || surface->shape != Surface::Shape::Triangles) {
            diagnostics.warn(light->path, "geometry",
                             "the mesh light has no mesh and gives no light");
            continue;
        }
        MeshLight meshLight{light, lightBaseRadiance(*light), int(_infos.size()), {}};
        const double places = scene.placeCount(surface->prim->group);
        if (!haveRoom(places * double(surface->topology().triangles.size()), input)) {
            warnOfMany(light->path, diagnostics);
            continue;
        }
        if (!light->filters.empty())
            for (const GroupPlace& place : scene.groupPlaces(surface->prim->group))
                meshLight.filters.emplace_back(*light, place.toWorld, scene.origin(),
                                               input.shutterOpen, images, diagnostics);
        if (light->normalize) {
            double area = -1.0;
            scene.forTransforms(surface->prim->group, [&](const mat4& place) {
                if (area < 0.0) area = areaOf(*surface, place);
            });
            if (area > 0.0) meshLight.radiance /= float(area);
        }
        _infos.push_back(describe(light, scene, settings));
        _infos.back().triangles = true;
        _meshLights[surface] = meshLight;
    }

    std::vector<const Surface*> surfaces = scene.emissiveSurfaces();
    for (const auto& item : _meshLights)
        surfaces.push_back(item.first);
    // In the order of their paths, so that equal scenes give equal light trees.
    std::sort(surfaces.begin(), surfaces.end(),
              [](const Surface* a, const Surface* b) { return a->prim->path < b->prim->path; });
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    _placements = scene.sharedPlacements();
    for (const Surface* surface : surfaces)
        addSurface(*surface, scene, input, diagnostics);
    _set = std::make_unique<LightSet>(std::move(input), images, diagnostics);
}

void SceneLights::addSurface(const Surface& surface, const EmbreeScene& scene, LightSetInput& input,
                             Diagnostics& diagnostics) {
    const auto meshLight = _meshLights.find(&surface);
    const bool isMeshLight = meshLight != _meshLights.end();
    const std::vector<uvec3>& triangles = surface.topology().triangles;
    EmittingSurface found;
    int glowing = 0;
    for (unsigned t = 0; t < triangles.size(); ++t)
        found.slots.push_back(isMeshLight || surface.material(t).program->hasEmission() ? glowing++
                                                                                        : -1);
    if (!haveRoom(scene.placeCount(surface.prim->group) * double(glowing), input)) {
        if (isMeshLight) {
            warnOfMany(meshLight->second.light->path, diagnostics);
            _meshLights.erase(meshLight);
        } else { // paths that meet it see it glow
            diagnostics.warn(
                surface.prim->path, "",
                "with it the scene has more glowing triangles, each wherever it is placed, than " +
                    limitText(Limit::lights) +
                    "; what it lights is found by chance alone, with more noise");
        }
        return;
    }
    for (const GroupPlace& where : scene.groupPlaces(surface.prim->group)) {
        const mat4& place = where.toWorld;
        Emitting emitting{place, std::vector<int>(size_t(glowing), -1)};
        const int number = int(_places.size());
        _places.push_back(where);
        for (unsigned t = 0; t < triangles.size(); ++t) {
            if (found.slots[t] < 0) continue;
            const bool glows = surface.material(t).program->hasEmission();
            LightTriangle triangle;
            for (int k = 0; k < 3; ++k)
                triangle.vertices[k] =
                    vec3(place * vec4(surface.placed.positions[0][triangles[t][k]], 1.0f));
            // One-sided triangles shine along their winding; a mirroring transform turned it.
            const bool mirrored =
                surface.flipNormals != (glm::determinant(glm::mat3(place)) < 0.0f);
            const vec3 ng = glm::cross(triangle.vertices[1] - triangle.vertices[0],
                                       triangle.vertices[2] - triangle.vertices[0]);
            const float length = glm::length(ng);
            if (!(length > 0.0f)) continue;
            triangle.twoSided = glows || mirrored;
            const vec3 n = ng / length * (mirrored ? -1.0f : 1.0f);
            float brightest = 0.0f;
            for (const vec2 uv : {vec2(1 / 3.0f), vec2(0.1f), vec2(0.8f, 0.1f), vec2(0.1f, 0.8f)}) {
                const Hit hit = hitOn(&surface, t, where, uv);
                SurfacePoint point;
                const vec3 p = triangle.vertices[0] * (1 - uv.x - uv.y) +
                               triangle.vertices[1] * uv.x + triangle.vertices[2] * uv.y;
                // Each side may have a shader of its own.
                for (const float side : {1.0f, -1.0f}) {
                    computeSurfacePoint(hit, p + n * side, -n * side, 0.0f, point);
                    brightest = std::max(brightest, luminance(glm::abs(emission(point))));
                    if (!glows) break;
                }
            }
            if (!(brightest > 0.0f) && surface.material(t).program->constant()) continue;
            triangle.luminance = std::max(brightest, 1e-6f);
            emitting.triangles[size_t(found.slots[t])] = int(input.triangles.size());
            input.triangles.push_back(triangle);
            _sources.push_back({&surface, t, number});
            _triangleInfos.push_back(isMeshLight ? meshLight->second.info : _glowInfo);
        }
        found.places.push_back(std::move(emitting));
    }
    if (!found.places.empty()) _emitting[&surface] = std::move(found);
}

int SceneLights::worthwhileSamples() const {
    constexpr int many = 16;
    if (_set->lightCount() > many) return 4;
    return _set->infiniteLights().empty() ? 1 : 2;
}

int SceneLights::triangleLight(const Surface* surface, unsigned primitive,
                               const mat4& groupToWorld) const {
    const auto found = _emitting.find(surface);
    if (found == _emitting.end()) return -1;
    const int slot = found->second.slots[primitive];
    if (slot < 0) return -1;
    const std::vector<Emitting>& places = found->second.places;
    const int triangle = places[nearestPlace(places, groupToWorld)].triangles[size_t(slot)];
    return triangle < 0 ? -1 : triangle + _set->lightCount();
}

size_t SceneLights::nearestPlace(const std::vector<Emitting>& places, const mat4& groupToWorld) {
    size_t nearest = 0;
    float best = INFINITY;
    for (size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
        float difference = 0.0f;
        for (int c = 0; c < 4; ++c) {
            const vec4 d = places[i].place[c] - groupToWorld[c];
            difference += glm::dot(d, d);
        }
        if (difference < best) {
            best = difference;
            nearest = i;
        }
    }
    return nearest;
}

vec3 SceneLights::emission(const SurfacePoint& point, const vec3* lit) const {
    const MaterialProgram& program = *point.slot->program;
    const ShadingPoint& s = point.shading;
    vec3 glow(0.0f);
    if (program.hasEmission()) glow = program.emission(s, s.viewDirection);
    if (_meshLights.empty()) return glow;
    const auto found = _meshLights.find(point.hit->surface);
    if (found == _meshLights.end()) return glow;
    const MeshLight& mesh = found->second;
    const bool front = glm::dot(s.geometricNormal, s.viewDirection) > 0.0f;
    vec3 light = front ? mesh.radiance : vec3(0.0f);
    if (lit && !mesh.filters.empty()) {
        const size_t place =
            nearestPlace(_emitting.at(point.hit->surface).places, point.hit->groupToWorld);
        light *= mesh.filters[place].factor(*lit, -s.viewDirection, glm::length(s.position - *lit),
                                            point.hit->time);
    }
    if (mesh.light->materialSyncMode == "noMaterialResponse") return light;
    if (mesh.light->materialSyncMode == "materialGlowTintsLight" && program.hasEmission())
        return light * glow;
    return light + glow;
}

vec3 SceneLights::triangleRadiance(const LightSample& sample, const vec3& from, float time) const {
    const Source& source = _sources[sample.triangle];
    Hit hit =
        hitOn(source.surface, source.primitive, _places[size_t(source.place)], sample.barycentrics);
    hit.distance = sample.distance;
    hit.time = time;
    SurfacePoint point;
    computeSurfacePoint(hit, from, sample.direction, 0.0f, point);
    float presence = 1.0f;
    if (!point.slot->opaque) point.slot->program->opacity(point.shading, nullptr, &presence);
    return emission(point, &from) * presence;
}

bool SceneLights::hidesMaterial(const Surface* surface) const {
    const auto found = _meshLights.find(surface);
    return found != _meshLights.end() &&
           found->second.light->materialSyncMode == "noMaterialResponse";
}

} // namespace patina
