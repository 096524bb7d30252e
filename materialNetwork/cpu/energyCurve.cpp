// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/lobeEnergy.h"

#include <cmath>

namespace patina {

namespace {

// Linear interpolation is then within 1.5e-3 of the tables (tests/testEnergyCurve.cpp). Nodes are
// dense at grazing angles, where albedos change over a width like alpha; below narrowest that is
// not dense enough.
constexpr float narrowest = 0.01f;

} // namespace

EnergyCurve::Energy lobeEnergy(const BsdfLobe& lobe, const glm::vec3& wo) {
    if (lobe.kind == LobeKind::Conductor) {
        const glm::vec3 none(0.0f);
        return {sh::conductorAt(lobe.conductor, wo).k, none, none, none};
    }
    if (lobe.kind == LobeKind::Dielectric) {
        const sh::DielectricEnergy e = sh::dielectricEnergy(lobe.dielectric, wo);
        return {glm::vec3(e.kr), glm::vec3(e.kt), glm::vec3(e.r), glm::vec3(e.t)};
    }
    const sh::SchlickEnergy e = sh::schlickEnergy(lobe.schlick, wo);
    return {e.kr, e.kt, e.r, e.t};
}

namespace {

std::vector<EnergyCurve::Energy> sampled(const BsdfLobe& lobe, int count, float side) {
    std::vector<EnergyCurve::Energy> nodes;
    for (int i = 0; i < count; ++i) {
        const float t = float(i) / float(count - 1);
        const float z = t * t * t * t;
        nodes.push_back(
            lobeEnergy(lobe, glm::vec3(std::sqrt(std::fmax(0.0f, 1.0f - z * z)), 0.0f, side * z)));
    }
    return nodes;
}

/// The cubic of Catmull and Rom (1974), kept to the range of its nodes: beside a step it would
/// swing beyond them, and a factor below 0.
glm::vec3 cubic(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d,
                float f) {
    const glm::vec3 first = c - a, second = 2.0f * a - 5.0f * b + 4.0f * c - d;
    const glm::vec3 value = b + 0.5f * f * (first + f * (second + f * (3.0f * (b - c) + d - a)));
    return glm::clamp(value, glm::min(glm::min(a, b), glm::min(c, d)),
                      glm::max(glm::max(a, b), glm::max(c, d)));
}

EnergyCurve::Energy readCubic(const std::vector<EnergyCurve::Energy>& nodes, float z) {
    const int last = int(nodes.size()) - 1;
    const float t = std::sqrt(std::sqrt(z < 1.0f ? z : 1.0f)) * float(last);
    int i = int(t);
    i = i < last - 1 ? i : last - 1;
    const float f = t - float(i);
    const auto node = [&](int k) -> const EnergyCurve::Energy& {
        return nodes[size_t(k < 0 ? 0 : k < last ? k : last)];
    };
    const auto &a = node(i - 1), &b = node(i), &c = node(i + 1), &d = node(i + 2);
    return {cubic(a.kr, b.kr, c.kr, d.kr, f), cubic(a.kt, b.kt, c.kt, d.kt, f),
            cubic(a.r, b.r, c.r, d.r, f), cubic(a.t, b.t, c.t, d.t, f)};
}

} // namespace

void EnergyCurve::measure(const BsdfLobe& lobe) {
    _nodes.clear();
    _fine.clear();
    _below.clear();
    glm::vec2 alpha(0.0f);
    float ior = 1.0f;
    int method = sh::ALBEDO_TABLE, mode = sh::SCATTER_R;
    const auto read = [&](const auto& l) {
        alpha = l.alpha;
        method = l.albedo;
    };
    if (lobe.kind == LobeKind::Dielectric) {
        read(lobe.dielectric);
        ior = lobe.dielectric.ior;
        mode = lobe.dielectric.mode;
    } else if (lobe.kind == LobeKind::Schlick) {
        read(lobe.schlick);
        ior = lobe.schlick.ior;
        mode = lobe.schlick.mode;
    } else if (lobe.kind == LobeKind::Conductor) {
        read(lobe.conductor);
    } else {
        return;
    }
    const bool slow = method >= sh::ALBEDO_SAMPLES_16;
    if (alpha.x != alpha.y || !(alpha.x > 0.0f) || ior < 1.0f) return;
    if (slow) {
        _fine = sampled(lobe, fineCount, 1.0f);
        if ((mode & sh::SCATTER_T) != 0) _below = sampled(lobe, fineCount, -1.0f);
    }
    if (lobe.kind == LobeKind::Conductor || alpha.x < narrowest) return;
    if (!slow) {
        _nodes = sampled(lobe, nodeCount, 1.0f);
        return;
    }
    for (int i = 0; i < nodeCount; ++i) {
        const float t = float(i) / float(nodeCount - 1);
        _nodes.push_back(readCubic(_fine, t * t * t * t));
    }
}

EnergyCurve::Energy EnergyCurve::at(float z) const {
    if (z < 0.0f) return readCubic(_below, -z);
    if (!_fine.empty()) return readCubic(_fine, z);
    const float t = std::sqrt(std::sqrt(z < 1.0f ? z : 1.0f)) * float(nodeCount - 1);
    int i = int(t);
    i = i < nodeCount - 2 ? i : nodeCount - 2;
    const float f = t - float(i);
    const Energy &a = _nodes[size_t(i)], &b = _nodes[size_t(i) + 1];
    return {a.kr + (b.kr - a.kr) * f, a.kt + (b.kt - a.kt) * f, a.r + (b.r - a.r) * f,
            a.t + (b.t - a.t) * f};
}

} // namespace patina
