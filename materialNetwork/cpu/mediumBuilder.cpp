#include "materialNetwork/cpu/mediumBuilder.h"

#include "materialNetwork/cpu/scratch.h"

#include <algorithm>

namespace patina {

namespace {

/// Authored coefficients: negative and NaN count as 0.
glm::vec3 coefficient(const glm::vec3& c) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i)
        result[i] = c[i] > 0.0f ? std::min(c[i], Medium::maxCoefficient) : 0.0f;
    return result;
}

float unit(float x) {
    return x > 0.0f ? std::min(x, 1.0f) : 0.0f;
}

} // namespace

void Medium::addScattering(const glm::vec3& scattering, float anisotropy) {
    if (scattering == glm::vec3(0.0f)) return;
    const float g = anisotropy == anisotropy ? std::clamp(anisotropy, -1.0f, 1.0f) : 0.0f;
    for (int i = 0; i < phaseCount; ++i)
        if (phases[i].anisotropy == g) {
            phases[i].scattering += scattering;
            return;
        }
    if (phaseCount < maxPhases) {
        phases[phaseCount++] = {scattering, g};
        return;
    }
    Phase& last = phases[maxPhases - 1];
    const auto amount = [](const glm::vec3& c) { return c.x + c.y + c.z; };
    const float share = amount(scattering) / (amount(scattering) + amount(last.scattering));
    last.anisotropy += (g - last.anisotropy) * share;
    last.scattering += scattering;
}

Medium buildMedium(const std::vector<ClosureOp>& vdf, const glm::vec4* registers) {
    Medium medium;
    const int n = int(vdf.size());
    if (n == 0) return medium;
    Scratch<glm::vec3> weight(size_t(n) + 1);
    for (int i = 0; i < n; ++i)
        weight[i] = glm::vec3(0.0f);
    weight[n - 1] = glm::vec3(1.0f);
    for (int i = n - 1; i >= 0; --i) {
        const ClosureOp& op = vdf[size_t(i)];
        const glm::vec3 w = weight[i];
        if (w == glm::vec3(0.0f)) continue;
        const auto give = [&](int part, const glm::vec3& share) {
            if (part >= 0) weight[part] += share;
        };
        switch (op.kind) {
        case ClosureKind::Mix: {
            const float m = unit(registers[op.factor].x);
            give(op.a, w * m);
            give(op.b, w * (1.0f - m));
            break;
        }
        case ClosureKind::Add:
            give(op.a, w);
            give(op.b, w);
            break;
        case ClosureKind::Multiply:
            give(op.a, w * coefficient(glm::vec3(registers[op.factor])));
            break;
        case ClosureKind::AnisotropicVdf:
            medium.addScattering(coefficient(w * glm::vec3(registers[op.scattering])),
                                 registers[op.anisotropy].x);
            medium.absorption += coefficient(w * glm::vec3(registers[op.factor]));
            break;
        case ClosureKind::AbsorptionVdf:
            medium.absorption += coefficient(w * glm::vec3(registers[op.factor]));
            break;
        default: break;
        }
    }
    return medium;
}

} // namespace patina
