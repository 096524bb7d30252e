#include "materialNetwork/cpu/energyCurve.h"

#include <cmath>

namespace patina {

namespace {

// Linear interpolation is then within 1.5e-3 of the tables (tests/testEnergyCurve.cpp). Nodes are
// dense at grazing angles, where albedos change over a width like alpha; below narrowest that is
// not dense enough.
constexpr float narrowest = 0.01f;

} // namespace

EnergyCurve::Energy lobeEnergy(const BsdfLobe& lobe, const glm::vec3& wo) {
    if (lobe.kind == LobeKind::Dielectric) {
        const sh::DielectricEnergy e = sh::dielectricEnergy(lobe.dielectric, wo);
        return {glm::vec3(e.kr), glm::vec3(e.kt), glm::vec3(e.r), glm::vec3(e.t)};
    }
    const sh::SchlickEnergy e = sh::schlickEnergy(lobe.schlick, wo);
    return {e.kr, e.kt, e.r, e.t};
}

void EnergyCurve::measure(const BsdfLobe& lobe) {
    _nodes.clear();
    const bool dielectric = lobe.kind == LobeKind::Dielectric;
    if (!dielectric && lobe.kind != LobeKind::Schlick) return;
    const glm::vec2 alpha = dielectric ? lobe.dielectric.alpha : lobe.schlick.alpha;
    const float ior = dielectric ? lobe.dielectric.ior : lobe.schlick.ior;
    if (alpha.x != alpha.y || alpha.x < narrowest || ior < 1.0f) return;
    for (int i = 0; i < nodeCount; ++i) {
        const float t = float(i) / float(nodeCount - 1);
        const float z = t * t * t * t;
        _nodes.push_back(
            lobeEnergy(lobe, glm::vec3(std::sqrt(std::fmax(0.0f, 1.0f - z * z)), 0.0f, z)));
    }
}

EnergyCurve::Energy EnergyCurve::at(float z) const {
    const float t = std::sqrt(std::sqrt(z < 1.0f ? z : 1.0f)) * float(nodeCount - 1);
    int i = int(t);
    i = i < nodeCount - 2 ? i : nodeCount - 2;
    const float f = t - float(i);
    const Energy &a = _nodes[size_t(i)], &b = _nodes[size_t(i) + 1];
    return {a.kr + (b.kr - a.kr) * f, a.kt + (b.kt - a.kt) * f, a.r + (b.r - a.r) * f,
            a.t + (b.t - a.t) * f};
}

} // namespace patina
