// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/sceneLights.h"

#include "hdDelegate/compiled/cameraFrame.h"
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

SceneLights::MeshLight::Glow SceneLights::MeshLight::glowOf(const Light& light) {
    return light.materialSyncMode == "noMaterialResponse"       ? Glow::Hidden
           : light.materialSyncMode == "materialGlowTintsLight" ? Glow::TintsLight
                                                                : Glow::AddsToLight;
}

bool SceneLights::haveRoom(double more, const LightSetInput& input) {
    const double sum = double(input.lights.size()) + double(input.triangleCount) + more;
    return sum <= double(limitOf(Limit::lights));
}

void SceneLights::warnOfMany(const std::string& light, Diagnostics& diagnostics) {
    diagnostics.warn(light, "", messages::lightsTooMany(limitText(Limit::lights)));
}

LightInfo SceneLights::describe(const std::shared_ptr<const Light>& light, const EmbreeScene& scene,
                                const RenderSettings& settings) {
    LightInfo info;
    info.lightCategory = info.shadowCategory = everything;
    info.ownShadows = !settings.enableShadows;
    _hasOwnShadows |= info.ownShadows;
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
    info.shadowFalloff = std::min(light->shadowFalloff, light->shadowDistance);
    info.shadowFalloffGamma = light->shadowFalloffGamma;
    info.ownShadows |= !info.castsShadows || info.shadowColor != vec3(0.0f) ||
                       info.shadowDistance > 0.0f || info.shadowCategory != everything;
    _hasOwnShadows |= info.ownShadows;
    _linksSurfaces |= info.lightCategory != everything;
    _splitsLobes |= info.diffuse != 1.0f || info.specular != 1.0f;
    return info;
}

SceneLights::SceneLights(const SceneState& state, const EmbreeScene& scene, const Camera& camera,
                         const RenderSettings& settings, LightImages& images,
                         Diagnostics& diagnostics)
    : _glowing(scene.places().placements()) {
    LightSetInput input;
    input.origin = scene.origin();
    const vec2 shutter = shutterOf(camera, settings);
    input.shutterOpen = shutter.x;
    input.shutterClose = shutter.y;
    std::map<std::string, std::vector<mat4>> places;
    std::vector<std::shared_ptr<const Light>> meshLights;
    for (const auto& item : state.lights) {
        const auto& light = item.second;
        if (!light->visible || !settings.enableSceneLights) continue;
        if (light->type == LightType::Mesh) {
            meshLights.push_back(light);
            continue;
        }
        if (!haveRoom(scene.places().count(light->group), input)) {
            warnOfMany(light->path, diagnostics);
            continue;
        }
        if (!places.count(light->group))
            places[light->group] = scene.places().transforms(light->group);
        for (const mat4& place : places[light->group]) {
            input.lights.push_back({light, place});
            _infos.push_back(describe(light, scene, settings));
        }
    }
    _glowInfo = int(_infos.size());
    _infos.push_back(describe(nullptr, scene, settings));
    _infos.back().triangles = true;

    for (const auto& light : meshLights) {
        const Surface* surface = scene.surfaces().find(light->geometry).get();
        if (!surface || surface->shape != Surface::Shape::Triangles) {
            diagnostics.warn(light->path, "geometry", messages::meshLightWithoutMesh);
            continue;
        }
        MeshLight meshLight{
            light, lightBaseRadiance(*light), int(_infos.size()), MeshLight::glowOf(*light), {},
            {}};
        _hidesMaterials |= meshLight.glow == MeshLight::Glow::Hidden;
        const double places = scene.places().count(surface->prim->group);
        if (!haveRoom(places * double(surface->topology().triangles.size()), input)) {
            warnOfMany(light->path, diagnostics);
            continue;
        }
        if (!light->filters.empty())
            for (const GroupPlace& place : scene.places().places(surface->prim->group))
                meshLight.filters.emplace_back(*light, place.toWorld, scene.origin(),
                                               input.shutterOpen, images, diagnostics);
        if (light->normalize) {
            std::vector<float>& areas = meshLight.areas;
            for (const GroupPlace& place : scene.places().places(surface->prim->group)) {
                const double area = areaOf(*surface, place.toWorld);
                areas.push_back(area > 0.0 ? float(area) : 1.0f);
            }
            if (!areas.empty() && std::all_of(areas.begin(), areas.end(), [&](float area) {
                    return std::abs(area - areas[0]) <= 1e-5f * areas[0];
                })) {
                meshLight.radiance /= areas[0];
                areas.clear();
            }
        }
        _infos.push_back(describe(light, scene, settings));
        _infos.back().triangles = true;
        _meshLights[surface] = meshLight;
    }

    std::vector<const Surface*> surfaces = scene.surfaces().emissive();
    for (const auto& item : _meshLights)
        surfaces.push_back(item.first);
    // In the order of their paths, so that equal scenes give equal light trees.
    std::sort(surfaces.begin(), surfaces.end(),
              [](const Surface* a, const Surface* b) { return a->prim->path < b->prim->path; });
    surfaces.erase(std::unique(surfaces.begin(), surfaces.end()), surfaces.end());
    for (const Surface* surface : surfaces)
        addSurface(*surface, scene, input, diagnostics);
    _set = std::make_unique<LightSet>(std::move(input), images, diagnostics);
}

void SceneLights::addSurface(const Surface& surface, const EmbreeScene& scene, LightSetInput& input,
                             Diagnostics& diagnostics) {
    const auto meshLight = _meshLights.find(&surface);
    const bool isMeshLight = meshLight != _meshLights.end();
    // Glow lights what the rays that see it come from. Those that do find it by chance.
    if (!isMeshLight && (surface.prim->visibility.mask() & RayIndirect) != RayIndirect) return;
    int glowing = 0;
    for (unsigned t = 0; t < surface.topology().triangles.size(); ++t)
        glowing += isMeshLight || surface.material(t).program->hasEmission();
    if (haveRoom(scene.places().count(surface.prim->group) * double(glowing), input)) {
        _glowing.add(
            surface, scene.places().places(surface.prim->group),
            isMeshLight ? meshLight->second.info : _glowInfo, isMeshLight,
            !isMeshLight || meshLight->second.areas.empty(),
            [this](const SurfacePoint& point, size_t place) {
                return emission(point, nullptr, int(place));
            },
            input);
    } else if (isMeshLight) {
        warnOfMany(meshLight->second.light->path, diagnostics);
        _meshLights.erase(meshLight);
    } else { // paths that meet it see it glow
        diagnostics.warn(surface.prim->path, "",
                         messages::glowingTooMany(limitText(Limit::lights)));
    }
}

int SceneLights::triangleLight(const Hit& hit) const {
    const auto [place, triangle] = _glowing.find(hit);
    return place < 0 ? -1 : _set->lightCount() + _set->glowing(place).first + triangle;
}

vec3 SceneLights::emission(const SurfacePoint& point, const vec3* lit, int place) const {
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
    const bool filters = lit && !mesh.filters.empty();
    if (place < 0 && (filters || !mesh.areas.empty())) place = _glowing.placeFromFirst(*point.hit);
    if (!mesh.areas.empty()) light /= mesh.areas[size_t(place)];
    if (filters)
        light *= mesh.filters[size_t(place)].factor(
            *lit, -s.viewDirection, glm::length(s.position - *lit), point.hit->time);
    if (mesh.glow == MeshLight::Glow::Hidden) return light;
    return mesh.glow == MeshLight::Glow::TintsLight && program.hasEmission() ? light * glow
                                                                             : light + glow;
}

vec3 SceneLights::triangleRadiance(const LightSample& sample, const vec3& from, float time) const {
    const int place = _set->placeOf(sample.triangle);
    Hit hit =
        _glowing.hit(place, sample.triangle - _set->glowing(place).first, sample.barycentrics);
    hit.distance = sample.distance;
    hit.time = time;
    SurfacePoint point;
    computeSurfacePoint(hit, from, sample.direction, 0.0f, point);
    float presence = 1.0f;
    if (!point.slot->opaque) point.slot->program->opacity(point.shading, nullptr, &presence);
    return emission(point, &from) * presence;
}

} // namespace patina
