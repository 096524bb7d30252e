// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/microsurface.h"

#include "materialNetwork/cpu/smithSurface.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxBounces = 1000; // roulette ends walks long before
constexpr int sureBounces = 8;   // that no roulette ends

/// A lobe as a walk on its microsurface sees it.
struct Walker {
    glm::vec2 alpha;
    int ndf;
    int mode;      ///< SCATTER_*
    bool refracts; ///< facets let light through
    float eta;     ///< ior of the far side over that of the side of wo
    float retro;
    glm::vec3 factor; ///< on what leaves
};

Walker walkerOf(const sh::ConductorLobe& l, const glm::vec3&) {
    return {l.alpha, l.ndf, sh::SCATTER_R, false, 1.0f, l.retro, glm::vec3(1.0f)};
}

Walker walkerOf(const sh::DielectricLobe& l, const glm::vec3& wo) {
    const float eta = sh::dielectricEta(l, wo.z);
    Walker w{l.alpha, l.ndf, l.mode, !l.full && !l.deltaT, eta, l.retro, glm::vec3(l.tint)};
    if (l.sharedInterface)
        w.factor *= sh::sharedInterfaceScale(sh::dielectricEnergy(l, wo).r, true);
    return w;
}

Walker walkerOf(const sh::SchlickLobe& l, const glm::vec3& wo) {
    // One that only reflects may be a metal: what it refracts is gone.
    const bool refracts = l.mode != sh::SCATTER_R && !l.deltaT;
    const float eta = sh::schlickEta(l, wo.z);
    Walker w{l.alpha, l.ndf, l.mode, refracts, eta, l.retro, glm::vec3(l.tint)};
    if (l.sharedInterface)
        w.factor *= sh::schlickSharedInterfaceScale(sh::schlickEnergy(l, wo).r, true);
    return w;
}

glm::vec3 reflectance(const sh::ConductorLobe& l, float c, float) {
    return sh::conductorReflectance(l, c);
}

glm::vec3 reflectance(const sh::DielectricLobe& l, float c, float eta) {
    return glm::vec3(sh::dielectricFresnel(l, c, eta));
}

glm::vec3 reflectance(const sh::SchlickLobe& l, float c, float eta) {
    return sh::schlickReflectance(l, c, eta);
}

sh::LobeEval singleEval(sh::ConductorLobe l, const glm::vec3& wo, const glm::vec3& wi) {
    l.known = true;
    l.compensate = sh::COMPENSATE_NONE;
    l.k = glm::vec3(1.0f);
    return sh::conductorEval(l, wo, wi);
}

sh::LobeEval singleEval(sh::DielectricLobe l, const glm::vec3& wo, const glm::vec3& wi) {
    l.known = true;
    l.compensate = sh::COMPENSATE_NONE;
    l.kr = l.kt = 1.0f;
    return sh::dielectricEval(l, wo, wi);
}

sh::LobeEval singleEval(sh::SchlickLobe l, const glm::vec3& wo, const glm::vec3& wi) {
    l.known = true;
    l.compensate = sh::COMPENSATE_NONE;
    l.kr = l.kt = glm::vec3(1.0f);
    return sh::schlickEval(l, wo, wi);
}

/// The density of single scattering, mixed with that of diffuse light for what bounces on.
float mixedDensity(const Walker& walker, float single, float cosine) {
    const float lost =
        sh::multiLoss(std::sqrt(0.5f * glm::dot(walker.alpha, walker.alpha)), walker.ndf);
    const float rest = std::min(std::max(1.2f * lost, 0.01f), 0.9f);
    const float sides = walker.mode == sh::SCATTER_RT ? 0.5f : 1.0f;
    return (1.0f - rest) * single + rest * sides * sh::INV_PI * std::fabs(cosine);
}

/// A walk that has met the surface. The surface lies below: a ray that refracts is mirrored in the
/// plane of the surface, so that going up always means leaving.
template <class Lobe> class Walk {
public:
    Walk(const Lobe& lobe, const Walker& walker, const glm::vec3& o, HashedNumbers& random)
        : _lobe(lobe), _walker(walker), _surface(walker.alpha, walker.ndf), _random(random), _w(-o),
          _eta(walker.eta) {}

    /// @returns false when the ray leaves
    bool meets() {
        _below = _surface.nextBelow(_w, _below, double(_random.next()));
        return _below <= 1.0;
    }

    /// Bounces off a facet or goes through it.
    /// @param minimum of the chance to reflect
    void bounce(const glm::vec3& u, float minimum) {
        const glm::vec3 v = -_w;
        const glm::vec3 m = _surface.sampleVisibleNormal(v, glm::vec2(u), _random);
        const float c = std::min(std::max(glm::dot(v, m), 0.0f), 1.0f);
        const glm::vec3 f = reflectance(_lobe, c, _eta);
        const float chance =
            _walker.refracts ? minimum + (1.0f - minimum) * std::min(sh::lobeMean(f), 1.0f) : 1.0f;
        if (u.z < chance) {
            _throughput *= f / chance;
            _w = glm::normalize(m * (2.0f * c) - v);
            return;
        }
        _throughput *= (glm::vec3(1.0f) - f) / (1.0f - chance);
        _w = sh::microfacetDirection(v, m, c, _eta, false);
        _w.z = -_w.z;
        _below = 1.0 - _below;
        _eta = 1.0f / _eta;
        _crossed = !_crossed;
    }

    /// @returns false when roulette ends the walk
    bool goesOn(int bounces) {
        if (bounces < sureBounces) return true;
        const float chance =
            std::min(1.0f, std::max(_throughput.x, std::max(_throughput.y, _throughput.z)));
        if (!(_random.next() < chance)) return false;
        _throughput /= chance;
        return true;
    }

    /// Light that the next facet sends to i (in the frame of the side of wo) without another
    /// bounce.
    /// @param reflections false leaves out facets that reflect
    glm::vec3 towards(glm::vec3 i, bool crosses, bool reflections) const {
        const glm::vec3 v = -_w;
        if (_crossed) i.z = -i.z;
        float c = 0.0f;
        if (crosses == _crossed) {
            if (!reflections) return glm::vec3(0.0f);
            const double p = _surface.reflected(v, i, c) * _surface.leaves(i, _below);
            return p > 0.0 ? _throughput * reflectance(_lobe, c, _eta) * float(p) : glm::vec3(0.0f);
        }
        if (!_walker.refracts) return glm::vec3(0.0f);
        const double p = _surface.refracted(v, i, _eta, c) *
                         _surface.leaves(glm::vec3(i.x, i.y, -i.z), 1.0 - _below);
        return p > 0.0 ? _throughput * (glm::vec3(1.0f) - reflectance(_lobe, c, _eta)) * float(p)
                       : glm::vec3(0.0f);
    }

    bool crossed() const { return _crossed; }
    glm::vec3 direction() const { return {_w.x, _w.y, _crossed ? -_w.z : _w.z}; }
    const glm::vec3& throughput() const { return _throughput; }

private:
    const Lobe& _lobe;
    const Walker& _walker;
    SmithSurface _surface;
    HashedNumbers& _random;
    glm::vec3 _w;
    float _eta;
    double _below = 1.0;
    bool _crossed = false;
    glm::vec3 _throughput{1.0f};
};

/// Light that a reflection lobe refracts rarely comes back: most walks of such a lobe reflect.
float minReflected(const Walker& walker, int bounce) {
    return bounce == 0 && walker.mode == sh::SCATTER_R && walker.refracts ? 0.75f : 0.0f;
}

bool hasSide(const Walker& walker, bool crosses) {
    return (walker.mode & (crosses ? sh::SCATTER_T : sh::SCATTER_R)) != 0;
}

template <class Lobe> float density(const Lobe& lobe, const glm::vec3& wo, const glm::vec3& wi) {
    const Walker walker = walkerOf(lobe, wo);
    const bool crosses = (wi.z > 0.0f) != (wo.z >= 0.0f);
    if (!hasSide(walker, crosses) || wi.z == 0.0f) return 0.0f;
    return mixedDensity(walker, singleEval(lobe, wo, wi).pdf, wi.z);
}

template <class Lobe> sh::LobeEval eval(const Lobe& lobe, const glm::vec3& wo, const glm::vec3& wi,
                                        HashedNumbers& random) {
    const Walker walker = walkerOf(lobe, wo);
    const float side = wo.z >= 0.0f ? 1.0f : -1.0f;
    const bool crosses = !(wi.z * side > 0.0f);
    if (!hasSide(walker, crosses) || wi.z == 0.0f) return sh::lobeEvalNone();
    const float turn = crosses ? 1.0f : walker.retro;
    const glm::vec3 i(wi.x * turn, wi.y * turn, wi.z * side);
    const sh::LobeEval single = singleEval(lobe, wo, wi);
    // The reflection of the first facet is known; its refraction depends on the height here.
    glm::vec3 sum(0.0f);
    Walk<Lobe> walk(lobe, walker, {wo.x, wo.y, wo.z * side}, random);
    for (int bounce = 0; bounce < maxBounces && walk.meets(); ++bounce) {
        sum += walk.towards(i, crosses, bounce > 0);
        walk.bounce(random.next3(), minReflected(walker, bounce));
        if (!walk.goesOn(bounce)) break;
    }
    sh::LobeEval e;
    e.value = walker.factor * sum;
    if (!crosses) e.value += single.value;
    e.pdf = mixedDensity(walker, single.pdf, wi.z);
    return e;
}

template <class Lobe> sh::LobeSample sample(const Lobe& lobe, const glm::vec3& wo,
                                            const glm::vec3& u, HashedNumbers& random) {
    const Walker walker = walkerOf(lobe, wo);
    const float side = wo.z >= 0.0f ? 1.0f : -1.0f;
    Walk<Lobe> walk(lobe, walker, {wo.x, wo.y, wo.z * side}, random);
    for (int bounce = 0; walk.meets(); ++bounce) {
        if (bounce >= maxBounces) return sh::lobeSampleNone();
        walk.bounce(bounce == 0 ? u : random.next3(), minReflected(walker, bounce));
        if (!walk.goesOn(bounce)) return sh::lobeSampleNone();
    }
    const bool crosses = walk.crossed();
    if (!hasSide(walker, crosses)) return sh::lobeSampleNone();
    const glm::vec3 out = walk.direction();
    const float turn = crosses ? 1.0f : walker.retro;
    sh::LobeSample s;
    s.wi = glm::vec3(out.x * turn, out.y * turn, out.z * side);
    s.weight = walker.factor * walk.throughput();
    s.pdf = density(lobe, wo, s.wi);
    s.event = crosses ? sh::LOBE_TRANSMIT : sh::LOBE_REFLECT;
    s.eta = crosses ? 1.0f / walker.eta : 1.0f;
    return s;
}

} // namespace

bool canWalkMicrosurface(const BsdfLobe& lobe) {
    switch (lobe.kind) {
    case LobeKind::Conductor: return lobe.conductor.alpha.x > 0.0f;
    case LobeKind::Dielectric:
        return lobe.dielectric.alpha.x > 0.0f && !lobe.dielectric.matched &&
               (lobe.dielectric.mode == sh::SCATTER_R || !lobe.dielectric.deltaT);
    case LobeKind::Schlick:
        return lobe.schlick.alpha.x > 0.0f &&
               (lobe.schlick.mode == sh::SCATTER_R || !lobe.schlick.deltaT);
    default: return false;
    }
}

sh::LobeEval microsurfaceEval(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& wi,
                              HashedNumbers& random) {
    switch (l.kind) {
    case LobeKind::Conductor:
        return wo.z < 0.0f ? sh::lobeEvalNone() : eval(l.conductor, wo, wi, random);
    case LobeKind::Dielectric: return eval(l.dielectric, wo, wi, random);
    case LobeKind::Schlick: return eval(l.schlick, wo, wi, random);
    default: return sh::lobeEvalNone();
    }
}

float microsurfaceDensity(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& wi) {
    switch (l.kind) {
    case LobeKind::Conductor: return wo.z < 0.0f ? 0.0f : density(l.conductor, wo, wi);
    case LobeKind::Dielectric: return density(l.dielectric, wo, wi);
    case LobeKind::Schlick: return density(l.schlick, wo, wi);
    default: return 0.0f;
    }
}

sh::LobeSample microsurfaceSample(const BsdfLobe& l, const glm::vec3& wo, const glm::vec3& u,
                                  HashedNumbers& random) {
    switch (l.kind) {
    case LobeKind::Conductor:
        return wo.z < 0.0f ? sh::lobeSampleNone() : sample(l.conductor, wo, u, random);
    case LobeKind::Dielectric: return sample(l.dielectric, wo, u, random);
    case LobeKind::Schlick: return sample(l.schlick, wo, u, random);
    default: return sh::lobeSampleNone();
    }
}

} // namespace patina
