// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/integrator.h"

#include <optional>

// Vertices whose lobes differ between the wavelengths of a path.

namespace patina {

/// The wavelengths of a path are chosen where it first meets a material that disperses: until then
/// its three channels stand for all of the spectrum.
void Integrator::chooseWavelengths(Path& path, const MaterialProgram& program,
                                   ShadingPoint& s) const {
    HeroWavelengths& waves = path.waves;
    if (!waves.chosen()) path.throughput *= waves.begin(path.sampler.next2().x, _wavelengths);
    if (!waves.alone && !program.hasHeroWavelengths()) path.throughput *= waves.leaveOthers();
    s.wavelength = waves.nm[0];
}

bool Integrator::disperse(Path& path, SurfacePoint& point, const Hit& hit, float width,
                          const AovTarget& target, TraceCounters& counters) const {
    if (path.waves.alone) { // as without dispersion, then
        point.shading.wavelength = path.waves.nm[0];
        return scatter(path, point, hit, width, target, counters);
    }
    path.onPhotons = path.throughCasters = false;
    const MaterialProgram& program = *point.slot->program;
    chooseWavelengths(path, program, point.shading);
    Bsdf bsdf;
    setUpLobes(point, bsdf);
    std::optional<DispersedBsdf> dispersed;
    if (!path.waves.alone) {
        dispersed.emplace(program, point.shading, path.waves, bsdf);
        // Lobes of random values have no density that could weigh one wavelength by another.
        if (dispersed->stochastic()) {
            path.throughput *= path.waves.leaveOthers();
            dispersed.reset();
        }
    }
    if (bsdf.stochastic()) bsdf.seed(path.sampler.randomBits());
    show(path, point, bsdf, target);
    return !endsAt(path, hit) &&
           goOn(path, point, hit, bsdf, dispersed ? &*dispersed : nullptr, LightDraws(), counters);
}

} // namespace patina
