#include "materialNetwork/cpu/bsdf.h"

#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/shadingFrame.h"

namespace patina {

BsdfEval Bsdf::eval(const glm::vec3& wi) const {
    BsdfEval result;
    const bool reflects = (glm::dot(wi, _geometricNormal) > 0.0f) == _woOutside;
    int frame = -1;
    glm::vec3 local;
    for (int i = 0; i < _lobeCount; ++i) {
        const BsdfLobe& l = _lobes[i];
        const BsdfFrame& f = _frames[l.frame];
        if (_walks && l.kind == LobeKind::Subsurface) continue;
        if (l.frame != frame) {
            local = f.toLocal(wi);
            frame = l.frame;
        }
        if (((local.z > 0.0f) == (f.wo.z >= 0.0f)) != reflects) continue;
        const sh::LobeEval e = lobeEval(l, f.wo, local);
        (l.diffuse ? result.diffuse : result.specular) += l.weight * e.value;
        result.pdf += l.probability * e.pdf;
    }
    return result;
}

BsdfSample Bsdf::sample(const glm::vec3& u, float uLobe) const {
    BsdfSample result;
    if (_lobeCount == 0) return result;
    int chosen = 0;
    for (float sum = _lobes[0].probability; chosen + 1 < _lobeCount && uLobe >= sum;)
        sum += _lobes[++chosen].probability;
    const BsdfLobe& l = _lobes[chosen];
    const BsdfFrame& f = _frames[l.frame];
    result.lobe = chosen;
    if (_walks && l.kind == LobeKind::Subsurface) {
        result.wi = _woOutside ? -_geometricNormal : _geometricNormal;
        result.weight = l.weight / l.probability;
        result.pdf = l.probability;
        result.event = LOBE_SUBSURFACE | sh::LOBE_TRANSMIT | sh::LOBE_DELTA;
        result.diffuse = true;
        result.roughness = 1.0f;
        return result;
    }
    const sh::LobeSample s = lobeSample(l, f.wo, u);
    if (s.event == 0) return result;
    const glm::vec3 wi = f.toWorld(s.wi);
    const bool reflects = (s.event & sh::LOBE_REFLECT) != 0;
    if (((glm::dot(wi, _geometricNormal) > 0.0f) == _woOutside) != reflects) return result;

    result.wi = wi;
    result.event = s.event;
    result.diffuse = l.diffuse;
    result.eta = s.eta;
    result.roughness = lobeRoughness(l);
    if ((s.event & sh::LOBE_DELTA) != 0 || _lobeCount == 1) {
        result.weight = l.weight * s.weight / l.probability;
        result.pdf = s.pdf * l.probability;
        return result;
    }
    glm::vec3 value = l.weight * (s.weight * s.pdf);
    float pdf = l.probability * s.pdf;
    for (int i = 0; i < _lobeCount; ++i) {
        if (i == chosen) continue;
        const BsdfLobe& other = _lobes[i];
        if (_walks && other.kind == LobeKind::Subsurface) continue;
        const BsdfFrame& frame = _frames[other.frame];
        const glm::vec3 local = other.frame == l.frame ? s.wi : frame.toLocal(wi);
        if (((local.z > 0.0f) == (frame.wo.z >= 0.0f)) != reflects) continue;
        const sh::LobeEval e = lobeEval(other, frame.wo, local);
        value += other.weight * e.value;
        pdf += other.probability * e.pdf;
    }
    result.weight = pdf > 0.0f ? value / pdf : glm::vec3(0.0f);
    result.pdf = pdf;
    return result;
}

void Bsdf::walkSubsurface() {
    _walks = true;
    _nonDelta = false;
    for (int i = 0; i < _lobeCount; ++i)
        _nonDelta |= _lobes[i].kind != LobeKind::Subsurface && lobeNonDelta(_lobes[i]);
}

SubsurfaceEntry Bsdf::subsurface(const BsdfSample& sample) const {
    const SubsurfaceLobe& l = _lobes[sample.lobe].subsurface;
    return {l.diffuse.color, l.radius, l.anisotropy};
}

void Bsdf::makeDiffuse(const glm::vec3& normal, const glm::vec3& geometricNormal) {
    _lobeCount = 1;
    _nonDelta = true;
    _transmits = _walks = false;
    _woOutside = true;
    _geometricNormal = geometricNormal;
    BsdfFrame& f = _frames[0];
    f.normal = normal;
    completeBasis(normal, f.tangent, f.bitangent);
    f.wo = glm::vec3(0, 0, 1);
    BsdfLobe& l = _lobes[0];
    l.kind = LobeKind::OrenNayar;
    l.diffuse = true;
    l.frame = 0;
    l.probability = 1.0f;
    l.weight = l.albedo = glm::vec3(1.0f);
    l.orenNayar = sh::orenNayarSetup(glm::vec3(1.0f), 0.0f, false);
}

glm::vec3 Bsdf::albedo() const {
    glm::vec3 sum(0.0f);
    for (int i = 0; i < _lobeCount; ++i)
        sum += _lobes[i].weight * lobeAlbedo(_lobes[i], _frames[_lobes[i].frame].wo);
    return sum;
}

} // namespace patina
