// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include <optional>

// Vertices whose lobes differ between the wavelengths of a path. Apart from Integrator::trace(), so
// that paths that meet none pay nothing.

namespace patina {

/// The wavelengths of a path are chosen where it first meets a material that disperses: until then
/// its three channels stand for all of the spectrum.
void Integrator::chooseWavelengths(Path& path, const MaterialProgram& program,
                                   ShadingPoint& s) const {
    HeroWavelengths& waves = path.waves;
    if (!waves.chosen()) path.throughput *= waves.begin(path.sampler.next2().x);
    if (!waves.alone && !program.hasHeroWavelengths()) path.throughput *= waves.leaveOthers();
    s.wavelength = waves.nm[0];
}

bool Integrator::disperse(Path& path, SurfacePoint& point, const Hit& hit, const AovTarget* aovs,
                          TraceCounters& counters) const {
    path.onPhotons = path.throughCasters = false;
    const MaterialProgram& program = *point.slot->program;
    const ShadingPoint& s = point.shading;
    chooseWavelengths(path, program, point.shading);
    Bsdf bsdf;
    program.evaluate(s, bsdf);
    if (program.hasSubsurface()) bsdf.walkSubsurface();
    std::optional<DispersedBsdf> dispersed;
    if (!path.waves.alone) {
        dispersed.emplace(program, s, path.waves, bsdf);
        // Lobes of random values have no density that could weigh one wavelength by another.
        if (dispersed->stochastic()) {
            path.throughput *= path.waves.leaveOthers();
            dispersed.reset();
        }
    }
    const VertexBsdf vertex(bsdf, dispersed ? &*dispersed : nullptr);
    if (bsdf.stochastic()) bsdf.seed(path.sampler.randomBits());
    if (aovs) writeAovs(_aovs, *aovs, _camera, point, bsdf);
    const bool guided = _denoisingAlbedo >= 0 || _denoisingNormal >= 0;
    if (!path.featured && guided && bsdf.hasNonDelta()) {
        path.featured = true;
        path.featureAlbedo = path.throughput * bsdf.albedo();
        path.featureNormal = s.normal;
    }
    if (path.depth >= _settings.maxDepth || _lights.hidesMaterial(hit.surface)) return false;

    const uint32_t lightSamples = uint32_t(path.lightSamples);
    const Sampler::Set uLight = path.sampler.nextSet(lightSamples);
    if (vertex.hasNonDelta() && !_lights.set().empty())
        for (uint32_t i = 0; i < lightSamples; ++i) {
            const LightDraw draw =
                beginLight(path, point, vertex.transmits(), vec3(uLight.point4(i)));
            addRadiance(path, directLight(path, point, vertex, hit, draw, counters));
        }

    const vec4 uBsdf = path.sampler.next4();
    HeroWavelengths behind = path.waves;
    const BsdfSample next = dispersed ? dispersed->sample(vec3(uBsdf), uBsdf.w, behind)
                                      : bsdf.sample(vec3(uBsdf), uBsdf.w);
    if (next.event == 0) return false;
    path.throughput *= next.weight;
    if (!(luminance(path.throughput) > 0.0f)) return false;
    if ((next.event & LOBE_SUBSURFACE) != 0) {
        if (!passBeneath(path, point, hit, bsdf.subsurface(next), counters)) return false;
    } else {
        if ((next.event & sh::LOBE_TRANSMIT) != 0) path.media.cross(program, s);
        depart(path, point, hit, vertex, next);
    }
    path.waves = behind;
    ++path.depth;
    return true;
}

} // namespace patina
