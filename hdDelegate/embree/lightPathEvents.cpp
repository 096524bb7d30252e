// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/lightPathEvents.h"

namespace patina {

namespace {

EventType sideOf(const ShadingPoint& s, const vec3& direction) {
    const bool below = glm::dot(direction, s.geometricNormal) <= 0.0f;
    const bool seenFromBelow = glm::dot(s.viewDirection, s.geometricNormal) < 0.0f;
    return below == seenFromBelow ? EventType::Reflect : EventType::Transmit;
}

} // namespace

LightEvent LightPathEvents::emitter(int light) const {
    const LightInfo& info = _lights.info(light);
    const Surface* surface = _lights.triangleSurface(light);
    if (!info.prim) return glow(*surface);
    const LightLabels& labels = _aovs.set().labels();
    LightEvent event;
    event.type = info.dome ? EventType::Background : EventType::Light;
    event.label = labels.of(info.prim->lightGroup);
    if (surface && event.label == LightEvent::noLabel)
        event.label = labels.of(surface->prim->lightGroup);
    return event;
}

LightEvent LightPathEvents::glow(const Surface& surface) const {
    return {EventType::Object, EventScatter::None,
            _aovs.set().labels().of(surface.prim->lightGroup)};
}

void LightPathEvents::emission(const Path& path, const Hit& hit) const {
    const int light = _lights.triangleLight(hit);
    path.lightPaths->straight(light < 0 ? glow(*hit.surface) : emitter(light));
}

void LightPathEvents::direct(const Path& path, const ShadingPoint& s, const LightSample& light,
                             const BsdfEval& f, const vec3& incident) const {
    const LightInfo& info = _lights.info(light.light);
    path.lightPaths->lit(sideOf(s, light.direction), f.diffuse * info.diffuse * incident,
                         f.specular * info.specular * incident, emitter(light.light));
}

void LightPathEvents::shadow(const Path& path, const vec3& value, const LightSample& light,
                             const vec3& radiance, const vec3& seen) const {
    if (!_aovs.hasShadow() || !path.fromCamera()) return;
    // Light samples alone, which find all light of a surface that is no mirror.
    path.lightPaths->shadow +=
        path.throughput * value * radiance * _lights.image(light) *
        (glm::max(vec3(0.0f), 1.0f - seen) / (float(path.lightSamples) * light.pdf));
}

} // namespace patina
