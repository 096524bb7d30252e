// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/heroWavelengths.h"

#include <algorithm>

namespace patina {

namespace {

constexpr int count = HeroWavelengths::count;

/// Makes the parts sum to 1 where they sum to more than 0.
void share(vec3 (&parts)[count], const vec3& sum) {
    for (vec3& part : parts)
        for (int c = 0; c < 3; ++c)
            part[c] = sum[c] > 0.0f ? part[c] / sum[c] : 0.0f;
}

} // namespace

vec3 HeroWavelengths::begin(float u, const Wavelengths& wavelengths) {
    vec3 sum(0.0f);
    for (int i = 0; i < count; ++i) {
        float turned = u + float(i) / float(count);
        if (turned >= 1.0f) turned -= 1.0f;
        const Wavelengths::Drawn drawn = wavelengths.draw(turned);
        nm[i] = drawn.nm;
        shares[i] = drawn.weight / float(count);
        chances[i] = 1.0f;
        sum += shares[i];
    }
    share(shares, sum);
    return sum;
}

vec3 HeroWavelengths::leaveOthers() {
    // The chance that of this path and these wavelengths the first was the hero.
    const vec3 factor = shares[0] * (float(count) / chances[0]);
    for (int i = 0; i < count; ++i) {
        shares[i] = vec3(i == 0 ? 1.0f : 0.0f);
        chances[i] = i == 0 ? float(count) : 0.0f;
    }
    alone = true;
    return factor;
}

DispersedBsdf::DispersedBsdf(const MaterialProgram& program, const ShadingPoint& point,
                             const HeroWavelengths& waves, const Bsdf& hero)
    : _waves(waves), _hero(hero), _transmits(hero.transmits()), _nonDelta(hero.hasNonDelta()),
      _stochastic(hero.stochastic()) {
    ShadingPoint s = point;
    for (int i = 1; i < count; ++i) {
        Bsdf& bsdf = _others[i - 1];
        s.wavelength = waves.nm[i];
        program.evaluate(s, bsdf);
        if (program.hasSubsurface()) bsdf.walkSubsurface();
        _transmits |= bsdf.transmits();
        _nonDelta |= bsdf.hasNonDelta();
        _stochastic |= bsdf.stochastic();
    }
}

BsdfEval DispersedBsdf::eval(const vec3& wi) const {
    BsdfEval result;
    for (int i = 0; i < count; ++i) {
        const BsdfEval e = at(i).eval(wi);
        result.diffuse += _waves.shares[i] * e.diffuse;
        result.specular += _waves.shares[i] * e.specular;
        result.pdf += _waves.chances[i] * e.pdf / float(count);
    }
    return result;
}

BsdfSample DispersedBsdf::sample(const vec3& u, float uLobe, HeroWavelengths& after) const {
    BsdfSample drawn = _hero.sample(u, uLobe);
    after = _waves;
    if (drawn.event == 0) return drawn;
    if ((drawn.event & LOBE_SUBSURFACE) != 0) {
        // Lobes differ in their bases, which other lobes may have left out.
        drawn.weight *= after.leaveOthers();
        return drawn;
    }
    const bool delta = (drawn.event & sh::LOBE_DELTA) != 0;
    vec3 sum(0.0f);
    float density = 0.0f;
    for (int i = 0; i < count; ++i) {
        vec3 value = drawn.weight * drawn.pdf;
        float pdf = drawn.pdf;
        if (i > 0) { // the hero is what was drawn
            const BsdfEval e = delta ? at(i).evalDelta(_hero, drawn, u) : at(i).eval(drawn.wi);
            value = e.diffuse + e.specular;
            pdf = e.pdf;
        }
        after.shares[i] = _waves.shares[i] * value;
        after.chances[i] = _waves.chances[i] * pdf;
        sum += after.shares[i];
        density += after.chances[i] / float(count);
    }
    if (!(density > 0.0f)) return BsdfSample();
    share(after.shares, sum);
    after.alone = true;
    for (int i = 0; i < count; ++i) {
        after.chances[i] /= density;
        after.alone &= i == 0 || after.chances[i] == 0.0f;
    }
    drawn.weight = sum / density;
    drawn.pdf = density;
    return drawn;
}

} // namespace patina
