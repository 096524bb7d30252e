// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

// The record of a path for the AOVs of light paths, where some are asked for.

namespace patina {

LightEvent Integrator::emitterOf(int light) const {
    const LightInfo& info = _lights.info(light);
    const Surface* surface = _lights.triangleSurface(light);
    if (!info.prim) return glowOf(*surface);
    const LightLabels& labels = _lightPaths.set().labels();
    LightEvent event;
    event.type = info.dome ? EventType::Background : EventType::Light;
    event.label = labels.of(info.prim->lightGroup);
    if (surface && event.label == LightEvent::noLabel)
        event.label = labels.of(surface->prim->lightGroup);
    return event;
}

LightEvent Integrator::glowOf(const Surface& surface) const {
    return {EventType::Object, EventScatter::None,
            _lightPaths.set().labels().of(surface.prim->lightGroup)};
}

void Integrator::recordEmission(const Path& path, const Hit& hit) const {
    const int light = _lights.triangleLight(hit);
    path.lightPaths->straight(light < 0 ? glowOf(*hit.surface) : emitterOf(light));
}

namespace {

EventType sideOf(const ShadingPoint& s, const vec3& direction) {
    const bool below = glm::dot(direction, s.geometricNormal) <= 0.0f;
    const bool seenFromBelow = glm::dot(s.viewDirection, s.geometricNormal) < 0.0f;
    return below == seenFromBelow ? EventType::Reflect : EventType::Transmit;
}

} // namespace

void Integrator::recordDirect(const Path& path, const ShadingPoint& s, const LightSample& light,
                              const BsdfEval& f, const vec3& incident) const {
    const LightInfo& info = _lights.info(light.light);
    path.lightPaths->lit(sideOf(s, light.direction), f.diffuse * info.diffuse * incident,
                         f.specular * info.specular * incident, emitterOf(light.light));
}

void Integrator::addShadow(const Path& path, const vec3& value, const LightSample& light,
                           const vec3& radiance, const vec3& seen) const {
    if (!_lightPaths.hasShadow() || !path.fromCamera()) return;
    const vec3 image =
        _lights.info(light.light).triangles ? vec3(1.0f) : _lights.set().image(light);
    // Light samples alone, which find all light of a surface that is no mirror.
    path.lightPaths->shadow +=
        path.throughput * value * radiance * image *
        (glm::max(vec3(0.0f), 1.0f - seen) / (float(path.lightSamples) * light.pdf));
}

void Integrator::recordScatter(const Path& path, const BsdfSample& next,
                               const VertexBsdf& bsdf) const {
    const EventType type =
        (next.event & sh::LOBE_TRANSMIT) != 0 ? EventType::Transmit : EventType::Reflect;
    const bool singular = (next.event & sh::LOBE_DELTA) != 0;
    vec3 share(next.diffuse ? 1.0f : 0.0f);
    if (!singular) {
        const BsdfEval f = bsdf.evalDrawn(next);
        const vec3 sum = f.diffuse + f.specular;
        for (int c = 0; c < 3; ++c)
            if (sum[c] > 0.0f) share[c] = f.diffuse[c] / sum[c];
    }
    path.lightPaths->scatter(type, singular, share);
}

} // namespace patina
