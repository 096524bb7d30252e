// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/layerWalk.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/cpu/microsurface.h"
#include "materialNetwork/cpu/shadingFrame.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int maxBounces = 500; // roulette ends walks long before
constexpr int sureBounces = 6;  // that no roulette ends

/// Most that a walk may carry: where colours above 1 gain light at every bounce there is no finite
/// sum, and infinity times 0 is no number.
constexpr float maxThroughput = 1e15f;

/// Shares of the density: the base as seen through a smooth top, and diffuse light.
constexpr float throughTopShare = 0.7f, diffuseShare = 0.3f;

const EnergyCurve noCurve;

/// @returns false when roulette ends the walk
bool goesOn(int bounces, glm::vec3& throughput, HashedNumbers& random) {
    throughput = glm::min(throughput, glm::vec3(maxThroughput));
    const float maximum = std::max(throughput.x, std::max(throughput.y, throughput.z));
    if (!(maximum > 0.0f)) return false;
    if (bounces < sureBounces || maximum >= 1.0f) return true;
    if (!(random.next() < maximum)) return false;
    throughput /= maximum;
    return true;
}

float balance(float a, float b) {
    return a > 0.0f ? a / (a + b) : 0.0f;
}

} // namespace

LayerWalk::LayerWalk(const LayeredPoint& point, int op, const glm::vec3& wo)
    : _point(point), _op(point.code->bsdf[size_t(op)]), _wo(wo), _tint(1.0f) {
    const ClosureOp& top = point.code->bsdf[size_t(_op.a)];
    const LobeTemplate& t = point.code->lobes[size_t(top.lobe)];
    const glm::vec4* registers = point.registers.data();
    setupLobeAt(*point.code, size_t(top.lobe), registers, point.point, _top);
    if (_top.kind == LobeKind::Dielectric) {
        std::swap(_tint, _top.dielectric.tint);
        if (!_top.dielectric.full) _top.dielectric.mode = sh::SCATTER_RT;
    } else {
        std::swap(_tint, _top.schlick.tint);
        _top.schlick.mode = sh::SCATTER_RT;
    }
    _top.stochastic = t.walks && canWalkMicrosurface(_top);

    const FrameTemplate& f = point.code->frames[t.frame];
    ShadingPoint seen = point.point;
    seen.viewDirection = wo;
    _frame = makeFrame(f, registers, seen);
    _aboveIsOutside =
        (glm::dot(wo, seen.geometricNormal) >= 0.0f) == (glm::dot(wo, _frame.normal) >= 0.0f);
}

/// The top with what hangs on v (in its frame) looked up.
BsdfLobe LayerWalk::topAt(const glm::vec3& v) const {
    BsdfLobe top = _top;
    if (!top.stochastic) lobeFixWo(top, v, noCurve);
    return top;
}

sh::LobeEval LayerWalk::topEval(const glm::vec3& v, const glm::vec3& wi,
                                HashedNumbers& random) const {
    const glm::vec3 o = sh::toLocal(_frame, v), i = sh::toLocal(_frame, wi);
    if (!agrees(v, o) || !agrees(wi, i)) return sh::lobeEvalNone();
    return _top.stochastic ? microsurfaceEval(_top, o, i, random) : lobeEval(topAt(o), o, i);
}

float LayerWalk::topDensity(const glm::vec3& v, const glm::vec3& wi) const {
    const glm::vec3 o = sh::toLocal(_frame, v), i = sh::toLocal(_frame, wi);
    if (!agrees(v, o) || !agrees(wi, i)) return 0.0f;
    return _top.stochastic ? microsurfaceDensity(_top, o, i) : lobeEval(topAt(o), o, i).pdf;
}

LayerWalk::TopSample LayerWalk::topSample(const glm::vec3& v, const glm::vec3& u,
                                          HashedNumbers& random) const {
    const glm::vec3 o = sh::toLocal(_frame, v);
    TopSample result;
    if (!agrees(v, o)) return result;
    const sh::LobeSample s =
        _top.stochastic ? microsurfaceSample(_top, o, u, random) : lobeSample(topAt(o), o, u);
    if (s.event == 0) return result;
    result.wi = sh::toWorld(_frame, s.wi);
    const bool reflects = (s.event & sh::LOBE_REFLECT) != 0;
    if (!agrees(result.wi, s.wi) || (above(result.wi) == above(v)) != reflects) return result;
    result.weight = s.weight;
    result.pdf = s.pdf;
    result.event = s.event;
    result.eta = s.eta;
    return result;
}

void LayerWalk::baseAt(const glm::vec3& v, uint32_t seed, Bsdf& out) const {
    BsdfBuilder::buildPart(_point, _op.b, v, out);
    out.seed(seed);
}

/// Lobes without energy factors are reciprocal but for the square of the ior ratio; others are
/// evaluated the right way round.
glm::vec3 LayerWalk::outwards(const TopSample& entry, const glm::vec3& wi,
                              HashedNumbers& random) const {
    if (!_top.stochastic && (entry.event & sh::LOBE_DELTA) == 0)
        return entry.pdf > 0.0f ? topEval(entry.wi, wi, random).value / entry.pdf : glm::vec3(0.0f);
    const float below = std::fabs(glm::dot(entry.wi, _frame.normal));
    if (!(below > 0.0f)) return glm::vec3(0.0f);
    return entry.weight * (entry.eta * entry.eta * std::fabs(glm::dot(wi, _frame.normal)) / below);
}

BsdfEval LayerWalk::eval(const glm::vec3& wi, HashedNumbers& random) const {
    BsdfEval result;
    result.pdf = density(wi);
    const bool leavesAbove = above(wi);
    glm::vec3 v = _wo, throughput(1.0f);
    bool atTop = above(v);
    if (atTop && leavesAbove) result.specular += _tint * topEval(v, wi, random).value;
    const auto add = [&](const BsdfEval& e, const glm::vec3& factor) {
        result.diffuse += throughput * factor * e.diffuse;
        result.specular += throughput * factor * e.specular;
    };
    for (int bounce = 0; bounce < maxBounces; ++bounce) {
        if (atTop) {
            const TopSample s = topSample(v, random.next3(), random);
            if (s.event == 0 || above(s.wi)) break;
            throughput *= s.weight;
            v = -s.wi;
            atTop = false;
            continue;
        }
        Bsdf base;
        baseAt(v, random.bits(), base);
        if (base.empty()) break;
        if (!leavesAbove) {
            if (base.hasNonDelta()) add(base.eval(wi), glm::vec3(1.0f));
        } else if (base.hasNonDelta()) {
            const TopSample entry = topSample(wi, random.next3(), random);
            if (entry.event != 0 && !above(entry.wi)) {
                const BsdfEval e = base.eval(-entry.wi);
                const bool delta = (entry.event & sh::LOBE_DELTA) != 0;
                add(e, outwards(entry, wi, random) * (delta ? 1.0f : balance(entry.pdf, e.pdf)));
            }
        }
        const BsdfSample s = base.sample(random.next3(), random.next());
        if (s.event == 0 || !above(s.wi)) break;
        throughput *= s.weight;
        v = -s.wi;
        atTop = true;
        if (leavesAbove) {
            const glm::vec3 value = topEval(v, wi, random).value;
            if (value != glm::vec3(0.0f)) {
                const bool delta = (s.event & sh::LOBE_DELTA) != 0;
                const float share = delta ? 1.0f : balance(s.pdf, topDensity(wi, v));
                (s.diffuse ? result.diffuse : result.specular) += throughput * value * share;
            }
        }
        if (!goesOn(bounce, throughput, random)) break;
    }
    return result;
}

BsdfSample LayerWalk::sample(const glm::vec3& u, HashedNumbers& random) const {
    BsdfSample result;
    glm::vec3 v = _wo, throughput(1.0f);
    bool atTop = above(v), delta = true, diffuse = false;
    float eta = 1.0f, roughness = 0.0f;
    for (int bounce = 0; bounce < maxBounces; ++bounce) {
        glm::vec3 wi;
        if (atTop) {
            const TopSample s = topSample(v, bounce == 0 ? u : random.next3(), random);
            if (s.event == 0) return result;
            throughput *= s.weight;
            if (above(v) && above(s.wi)) throughput *= _tint;
            delta &= (s.event & sh::LOBE_DELTA) != 0;
            eta *= s.eta;
            roughness = std::max(roughness, lobeRoughness(_top));
            wi = s.wi;
        } else {
            Bsdf base;
            baseAt(v, random.bits(), base);
            const glm::vec3 first = bounce == 0 ? u : random.next3();
            const BsdfSample s = base.sample(first, random.next());
            if (s.event == 0) return result;
            throughput *= s.weight;
            delta &= (s.event & sh::LOBE_DELTA) != 0;
            diffuse = s.diffuse;
            eta *= s.eta;
            roughness = std::max(roughness, s.roughness);
            wi = s.wi;
        }
        if (above(wi) == atTop) {
            const bool reflects = above(wi) == above(_wo);
            result.wi = wi;
            result.weight = throughput;
            result.event =
                (reflects ? sh::LOBE_REFLECT : sh::LOBE_TRANSMIT) | (delta ? sh::LOBE_DELTA : 0);
            result.pdf = delta ? 1.0f : density(wi);
            result.diffuse = diffuse;
            result.eta = eta;
            result.roughness = roughness;
            return result;
        }
        v = -wi;
        atTop = !atTop;
        if (!goesOn(bounce, throughput, random)) return result;
    }
    return result;
}

float LayerWalk::refracted(glm::vec3& d) const {
    const glm::vec3 o = sh::toLocal(_frame, d);
    const bool dielectric = _top.kind == LobeKind::Dielectric;
    const float ior = dielectric ? _top.dielectric.ior : _top.schlick.ior;
    const float z = std::fabs(o.z), inside = sh::cosRefracted(z, ior);
    if (!(inside > 0.0f)) return 0.0f;
    const float side = o.z >= 0.0f ? 1.0f : -1.0f;
    d = glm::normalize(sh::toWorld(_frame, glm::vec3(o.x / ior, o.y / ior, side * inside)));
    return z / (ior * ior * inside);
}

float LayerWalk::density(const glm::vec3& wi) const {
    const glm::vec3 o = sh::toLocal(_frame, _wo);
    float result = 0.0f, rest = 1.0f;
    glm::vec3 v = _wo, d = wi;
    float jacobian = 1.0f;
    if (above(_wo)) {
        if (above(wi)) result += topDensity(_wo, wi);
        const float z = std::fabs(o.z);
        rest -= _top.kind == LobeKind::Dielectric
                    ? sh::dielectricFresnel(_top.dielectric, z, _top.dielectric.ior)
                    : std::min(sh::lobeMean(sh::schlickOutside(_top.schlick, z)), 1.0f);
        rest = std::max(rest, 0.01f);
        refracted(v);
    }
    if (above(wi)) jacobian = refracted(d);
    Bsdf base;
    baseAt(v, 0, base);
    if (jacobian > 0.0f) result += rest * throughTopShare * base.density(d) * jacobian;
    return result + rest * diffuseShare * sh::INV_PI * std::fabs(glm::dot(wi, _frame.normal));
}

} // namespace patina
