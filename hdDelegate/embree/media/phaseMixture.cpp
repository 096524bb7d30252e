#include "hdDelegate/embree/media/phaseMixture.h"

#include "shaders/shaders.h"

namespace patina {

using glm::vec3;

PhaseMixture::PhaseMixture(const Medium& medium, const vec3& throughput)
    : _count(medium.phaseCount) {
    const vec3 scattering = medium.scattering();
    float sum = 0.0f;
    for (int i = 0; i < _count; ++i) {
        Part& part = _parts[i];
        const Medium::Phase& phase = medium.phases[i];
        for (int c = 0; c < 3; ++c)
            part.share[c] = scattering[c] > 0.0f ? phase.scattering[c] / scattering[c] : 0.0f;
        part.anisotropy = phase.anisotropy;
        part.probability = glm::dot(part.share, throughput);
        sum += part.probability;
    }
    for (int i = 0; i < _count; ++i)
        _parts[i].probability = sum > 0.0f ? _parts[i].probability / sum : 1.0f / float(_count);
}

vec3 PhaseMixture::eval(const vec3& wo, const vec3& wi, float& pdf) const {
    vec3 value(0.0f);
    pdf = 0.0f;
    for (int i = 0; i < _count; ++i) {
        const auto lobe = sh::phaseHenyeyGreensteinSetup(_parts[i].anisotropy);
        const float p = sh::phaseHenyeyGreensteinEval(lobe, wo, wi).pdf;
        value += _parts[i].share * p;
        pdf += _parts[i].probability * p;
    }
    return value;
}

PhaseMixture::Sample PhaseMixture::sample(const vec3& wo, const glm::vec2& u, float uPart) const {
    Sample result;
    if (_count == 0) return result;
    int chosen = 0;
    for (float below = _parts[0].probability; chosen + 1 < _count && uPart >= below;)
        below += _parts[++chosen].probability;
    const auto lobe = sh::phaseHenyeyGreensteinSetup(_parts[chosen].anisotropy);
    result.wi = glm::normalize(sh::phaseHenyeyGreensteinSample(lobe, wo, vec3(u, 0.0f)).wi);
    const vec3 value = eval(wo, result.wi, result.pdf);
    if (result.pdf > 0.0f) result.weight = value / result.pdf;
    return result;
}

} // namespace patina
