// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/bsdf.h"

#include "materialNetwork/cpu/layerWalk.h"
#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/microsurface.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int albedoSamples = 32; // of stochastic lobes

} // namespace

BsdfEval Bsdf::eval(const glm::vec3& wi) const {
    return evalLobes(wi, Lobes::All);
}

float Bsdf::stochasticDensity(const BsdfLobe& l, const glm::vec3& wi,
                              const glm::vec3& local) const {
    return l.kind == LobeKind::Layered ? LayerWalk(*_layers, l.layered.op, _view).density(wi)
                                       : microsurfaceDensity(l, _frames[l.frame].wo, local);
}

BsdfEval Bsdf::evalStochastic(int i, const glm::vec3& wi, const glm::vec3& local) const {
    const BsdfLobe& l = _lobes[i];
    const BsdfFrame& f = _frames[l.frame];
    HashedNumbers random = HashedNumbers(_seed + uint32_t(i)).mix(f.wo).mix(local);
    if (l.kind == LobeKind::Layered)
        return LayerWalk(*_layers, l.layered.op, _view).eval(wi, random);
    const sh::LobeEval e = microsurfaceEval(l, f.wo, local, random);
    BsdfEval result;
    (l.diffuse ? result.diffuse : result.specular) = e.value;
    result.pdf = e.pdf;
    return result;
}

/// Densities are those of all lobes in any case.
BsdfEval Bsdf::evalLobes(const glm::vec3& wi, Lobes which) const {
    BsdfEval result;
    const bool reflects = sh::isReflected(wi, _geometricNormal, _woOutside);
    int frame = -1;
    glm::vec3 local;
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        const BsdfFrame& f = _frames[l.frame];
        if (walks(l)) continue;
        if (l.frame != frame) {
            local = sh::toLocal(f, wi);
            frame = l.frame;
        }
        // The parts of a layer have frames of their own.
        if (l.kind != LobeKind::Layered && !sh::lobeAgrees(f.wo.z, local.z, reflects)) continue;
        if (l.stochastic) {
            if (which != Lobes::All) {
                result.pdf += l.probability * stochasticDensity(l, wi, local);
                continue;
            }
            const BsdfEval e = evalStochastic(i, wi, local);
            result.diffuse += l.weight * e.diffuse;
            result.specular += l.weight * e.specular;
            result.pdf += l.probability * e.pdf;
            continue;
        }
        sh::addLobe(result, true, l.diffuse, l.weight, l.probability, lobeEval(l, f.wo, local));
    }
    return result;
}

/// A sample of one lobe as if it were alone, in world space and in the lobe's frame.
BsdfSample Bsdf::sampleLobe(const BsdfLobe& l, const glm::vec3& u, glm::vec3& local) const {
    const BsdfFrame& f = _frames[l.frame];
    BsdfSample result;
    sh::LobeSample s;
    if (l.stochastic) {
        HashedNumbers random = HashedNumbers(_seed ^ 0x5bd1e995u).mix(f.wo).mix(u);
        if (l.kind == LobeKind::Layered) {
            result = LayerWalk(*_layers, l.layered.op, _view).sample(u, random);
            local = sh::toLocal(f, result.wi);
            return result;
        }
        s = microsurfaceSample(l, f.wo, u, random);
    } else {
        s = lobeSample(l, f.wo, u);
    }
    local = s.wi;
    if (s.event == 0 || !(s.pdf > 0.0f)) return result;
    result.wi = sh::toWorld(f, s.wi);
    const bool reflects = (s.event & sh::LOBE_REFLECT) != 0;
    if (sh::isReflected(result.wi, _geometricNormal, _woOutside) != reflects) return result;
    result.weight = s.weight;
    result.pdf = s.pdf;
    result.event = s.event;
    result.diffuse = l.diffuse;
    result.eta = s.eta;
    result.roughness = lobeRoughness(l);
    return result;
}

BsdfSample Bsdf::sample(const glm::vec3& u, float uLobe) const {
    BsdfSample result;
    sh::Selection drawn = sh::selectionNone();
    for (int i = 0; i < _lobeCount && !drawn.found; ++i)
        sh::selectLobe(drawn, i, _lobes[i].probability, uLobe);
    if (drawn.lobe < 0) return result;
    const int chosen = drawn.lobe;
    const BsdfLobe& l = _lobes[chosen];
    if (walks(l)) {
        result.lobe = chosen;
        result.wi = _woOutside ? -_geometricNormal : _geometricNormal;
        result.weight = l.weight / l.probability;
        result.pdf = l.probability;
        result.event = LOBE_SUBSURFACE | sh::LOBE_TRANSMIT | sh::LOBE_DELTA;
        result.diffuse = true;
        result.roughness = 1.0f;
        return result;
    }
    glm::vec3 local;
    result = sampleLobe(l, u, local);
    result.lobe = chosen;
    result.alone = l.stochastic;
    if (result.event == 0) return result;
    const BsdfSample s = result;
    if ((s.event & sh::LOBE_DELTA) != 0 || _lobeCount == 1) {
        result.weight = sh::drawnAlone(l.weight, s.weight, l.probability);
        result.pdf = s.pdf * l.probability;
        return result;
    }
    const bool reflects = (s.event & sh::LOBE_REFLECT) != 0;
    glm::vec3 value = sh::drawnValue(l.weight, s.weight, s.pdf);
    float exact = l.probability * s.pdf; // of the lobes in `value`
    float estimate = 0.0f;               // of the others
    for (int i = 0; i < _lobeCount; ++i) {
        if (i == chosen) continue;
        const BsdfLobe& other = _lobes[i];
        if (walks(other)) continue;
        const BsdfFrame& frame = _frames[other.frame];
        const glm::vec3 theirs = other.frame == l.frame ? local : sh::toLocal(frame, s.wi);
        if (other.kind != LobeKind::Layered && !sh::lobeAgrees(frame.wo.z, theirs.z, reflects))
            continue;
        if (other.stochastic) {
            estimate += other.probability * stochasticDensity(other, s.wi, theirs);
            continue;
        }
        const sh::LobeEval e = lobeEval(other, frame.wo, theirs);
        (l.stochastic ? estimate : exact) += other.probability * e.pdf;
        if (!l.stochastic) value += other.weight * e.value;
    }
    if (!(l.stochastic || exact > 0.0f)) return BsdfSample();
    result.pdf = exact + estimate;
    if (l.stochastic)
        result.weight = sh::drawnAlone(l.weight, s.weight, l.probability);
    else
        result.weight = value / exact;
    return result;
}

BsdfEval Bsdf::evalDrawn(const BsdfSample& sample) const {
    if (!_stochastic) return eval(sample.wi);
    if (!sample.alone) return evalLobes(sample.wi, Lobes::Deterministic);
    BsdfEval result;
    (sample.diffuse ? result.diffuse : result.specular) = glm::vec3(1.0f);
    result.pdf = sample.pdf;
    return result;
}

void Bsdf::walkSubsurface() {
    _walks = true;
    _nonDelta = false;
    for (int i = 0; i < _lobeCount; ++i)
        _nonDelta |= _lobes[i].kind != LobeKind::Subsurface && lobeNonDelta(_lobes[i]);
    preferWalks();
}

/// Light samples find all other lobes, walks are found by being drawn alone, and what they bring
/// varies the more the darker they are: they are drawn as the root of their colour, up to half of
/// the time.
void Bsdf::preferWalks() {
    const auto walks = [](const BsdfLobe& l) { return l.kind == LobeKind::Subsurface; };
    const auto wanted = [](const BsdfLobe& l) {
        const glm::vec3& c = l.subsurface.diffuse.color;
        return l.probability / std::sqrt(std::clamp(std::max({c.x, c.y, c.z}), 1e-6f, 1.0f));
    };
    float before = 0.0f, after = 0.0f, others = 0.0f;
    for (int i = 0; i < _lobeCount; ++i) {
        (walks(_lobes[i]) ? before : others) += _lobes[i].probability;
        if (walks(_lobes[i])) after += wanted(_lobes[i]);
    }
    if (!(before > 0.0f) || !(others > 0.0f)) return;
    const float share =
        std::max(before / (before + others), std::min(after / (after + others), 0.5f));
    for (int i = 0; i < _lobeCount; ++i) {
        BsdfLobe& l = _lobes[i];
        l.probability =
            walks(l) ? wanted(l) * (share / after) : l.probability * ((1.0f - share) / others);
    }
}

SubsurfaceEntry Bsdf::subsurface(const BsdfSample& sample) const {
    const sh::SubsurfaceLobe& l = _lobes[sample.lobe].subsurface;
    return {l.diffuse.color, l.radius, l.anisotropy};
}

float Bsdf::ior() const {
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        if (l.kind == LobeKind::Dielectric && lobeTransmits(l)) return l.dielectric.ior;
        if (l.kind == LobeKind::Schlick && lobeTransmits(l)) return l.schlick.ior;
    }
    return 1.0f;
}

void Bsdf::makeDiffuse(const glm::vec3& normal, const glm::vec3& geometricNormal) {
    _lobeCount = 1;
    _nonDelta = true;
    _transmits = _walks = _stochastic = false;
    _layers.reset();
    _woOutside = true;
    _geometricNormal = geometricNormal;
    BsdfFrame& f = _frames[0];
    f.normal = normal;
    sh::completeBasis(normal, f.tangent, f.bitangent);
    f.wo = glm::vec3(0, 0, 1);
    BsdfLobe& l = _lobes[0];
    l.kind = LobeKind::OrenNayar;
    l.diffuse = true;
    l.stochastic = false;
    l.frame = l.place = 0;
    l.probability = 1.0f;
    l.weight = l.albedo = glm::vec3(1.0f);
    l.orenNayar = sh::orenNayarSetup(glm::vec3(1.0f), 0.0f, false);
}

bool Bsdf::isLambert(const BsdfLobe& l) const {
    return l.kind == LobeKind::Translucent || (l.kind == LobeKind::Subsurface && !_walks) ||
           (l.kind == LobeKind::OrenNayar && l.orenNayar.b == 0.0f);
}

/// @returns -1 where there is no such lobe
int Bsdf::lambertFrame() const {
    for (int i = 0; i < _lobeCount; ++i)
        if (isLambert(_lobes[i])) return _lobes[i].frame;
    return -1;
}

LambertPart Bsdf::lambertPart() const {
    LambertPart part;
    const int frame = lambertFrame();
    if (frame < 0) return part;
    const BsdfFrame& f = _frames[frame];
    part.normal = f.wo.z < 0.0f ? -f.normal : f.normal;
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        if (isLambert(l) && l.frame == frame)
            (lobeTransmits(l) ? part.transmitted : part.reflected) +=
                l.weight * lobeAlbedo(l, f.wo);
    }
    return part;
}

float Bsdf::dropLambert() {
    const int frame = lambertFrame();
    int kept = 0;
    float left = 0.0f;
    _nonDelta = _transmits = false;
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        if (isLambert(l) && l.frame == frame) continue;
        left += l.probability;
        _nonDelta |= !walks(l) && lobeNonDelta(l);
        _transmits |= lobeTransmits(l);
        if (i != kept) _lobes[kept] = l;
        ++kept;
    }
    _lobeCount = kept;
    for (int i = 0; i < kept; ++i)
        _lobes[i].probability /= left;
    return left;
}

glm::vec3 Bsdf::sampledAlbedo() const {
    HashedNumbers random = HashedNumbers(_seed).mix(_frames[0].wo);
    glm::vec3 sum(0.0f);
    for (int i = 0; i < albedoSamples; ++i) {
        const glm::vec3 u = random.next3();
        const BsdfSample s = sample(u, random.next());
        if (s.event == 0) continue;
        const bool beneath = (s.event & LOBE_SUBSURFACE) != 0;
        sum += beneath ? s.weight * subsurface(s).color : s.weight;
    }
    return sum / float(albedoSamples);
}

glm::vec3 Bsdf::likelyAlbedo() const {
    glm::vec3 sum(0.0f);
    for (int i = 0; i < _lobeCount; ++i)
        sum += _lobes[i].weight * _lobes[i].albedo;
    return sum;
}

glm::vec3 Bsdf::albedo() const {
    if (_stochastic) return sampledAlbedo();
    glm::vec3 sum(0.0f);
    for (int i = 0; i < _lobeCount; ++i)
        sum += _lobes[i].weight * lobeAlbedo(_lobes[i], _frames[_lobes[i].frame].wo);
    return sum;
}

} // namespace patina
