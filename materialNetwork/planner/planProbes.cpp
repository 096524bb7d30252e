// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/planner/planProbes.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/microsurface.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace patina {

float spread(int i, int dimension) {
    constexpr double steps[] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                0.5385972572236101};
    const double x = 0.5 + steps[dimension & 3] * (i + 1) + 0.618 * (dimension >> 2);
    return float(x - std::floor(x));
}

namespace {

constexpr int varyingPlaces = 64;
constexpr int cosines = 4;

/// What is no number, or below zero, counts as none.
float amountOf(const glm::vec3& c) {
    const float y = luminance(c);
    return std::isfinite(y) && y > 0.0f ? y : 0.0f;
}

/// Every primvar takes all values from 0 to 1, place by place.
class SpreadPrimvars : public PrimvarReader {
public:
    bool read(int slot, float out[4]) const override {
        for (int k = 0; k < 4; ++k)
            out[k] = spread(place * 7 + slot, k);
        return true;
    }
    int place = 0;
};

float rootOf(const glm::vec2& alpha) {
    return std::sqrt(std::max(0.5f * (alpha.x + alpha.y), 0.0f));
}

void describe(const BsdfLobe& l, ClosureContribution& out) {
    out.kind = lobeRow(l.kind).probe;
    switch (l.kind) {
    case LobeKind::Dielectric:
        out.roughness = rootOf(l.dielectric.alpha);
        out.reflectance = sh::fresnelDielectric(1.0f, l.dielectric.ior);
        return;
    case LobeKind::Conductor:
        out.roughness = rootOf(l.conductor.alpha);
        out.reflectance =
            amountOf(sh::fresnelConductor(1.0f, l.conductor.ior, l.conductor.extinction));
        out.thickness = l.conductor.film.thickness;
        return;
    case LobeKind::Schlick:
        out.roughness = rootOf(l.schlick.alpha);
        out.reflectance = amountOf(sh::fresnelSchlick(1.0f, l.schlick.fresnel));
        out.thickness = l.schlick.film.thickness;
        return;
    case LobeKind::Sheen: out.roughness = std::sqrt(std::max(l.sheen.roughness, 0.0f)); return;
    default: out.reflectance = amountOf(l.albedo);
    }
}

/// Whether a walk between layers asks for the albedo of an interface on top anew at each of its
/// steps: it is seen from both sides, so no table over the cosine serves, and light does not bounce
/// between its facets.
bool asksAnew(BsdfLobe top) {
    if (top.kind == LobeKind::Dielectric && !top.dielectric.full)
        top.dielectric.mode = sh::SCATTER_RT;
    if (top.kind == LobeKind::Schlick) top.schlick.mode = sh::SCATTER_RT;
    return !canWalkMicrosurface(top);
}

class ProgramProber {
public:
    explicit ProgramProber(const ProgramCode& code) : _code(code) {}

    std::vector<std::vector<DirectionProbe>> run() {
        const int places = _code.facts.constant ? 1 : varyingPlaces;
        std::vector<std::vector<DirectionProbe>> result;
        for (int i = 0; i < places; ++i) {
            result.emplace_back();
            for (int c = 0; c < cosines; ++c)
                result.back().push_back(probeAt(i, (float(c) + 0.5f) / cosines));
        }
        return result;
    }

private:
    DirectionProbe probeAt(int place, float cosine) {
        SpreadPrimvars primvars;
        primvars.place = place;
        ShadingPoint point;
        point.primvars = &primvars;
        point.position = point.objectPosition =
            glm::vec3(spread(place, 0), spread(place, 1), spread(place, 2));
        point.viewDirection = glm::vec3(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
        const ProgramCode& code = _code;
        RegisterFile registers(code);
        registers.run(code, code.surfaceCode, point);
        Bsdf bsdf;
        BsdfBuilder::assemble(code, point, registers.data(), bsdf);

        DirectionProbe probe;
        probe.cosine = cosine;
        std::vector<float> light(code.lobes.size());
        for (size_t i = 0; i < light.size(); ++i) {
            light[i] = amountOf(bsdf.lobe(int(i)).weight * bsdf.lobe(int(i)).albedo);
            probe.albedo += light[i];
        }
        if (!(probe.albedo > 0.0f)) return probe;
        for (size_t i = 0; i < code.bsdf.size(); ++i) {
            const ClosureOp& op = code.bsdf[i];
            if (op.lobe < 0) continue;
            const BsdfLobe& l = bsdf.lobe(op.lobe);
            ClosureContribution contribution;
            contribution.closure = int(i);
            describe(l, contribution);
            contribution.share = light[size_t(op.lobe)] / probe.albedo;
            contribution.tabulated =
                !code.lobes[size_t(op.lobe)].energy.empty() && !(isTop(int(i)) && asksAnew(l));
            if (contribution.share > 0.0f) probe.closures.push_back(contribution);
        }
        for (ClosureContribution& contribution : probe.closures)
            contribution.beneath =
                std::min(beneath(contribution.closure, light) / probe.albedo, 1.0f);
        return probe;
    }

    bool isTop(int closure) const {
        return std::any_of(_code.bsdf.begin(), _code.bsdf.end(), [&](const ClosureOp& op) {
            return op.kind == ClosureKind::Layer && op.a == closure;
        });
    }

    std::set<int> lobesOf(int closure) const {
        std::set<int> lobes;
        std::vector<int> open = {closure};
        std::set<int> met;
        while (!open.empty()) {
            const int i = open.back();
            open.pop_back();
            if (i < 0 || !met.insert(i).second) continue;
            const ClosureOp& op = _code.bsdf[size_t(i)];
            if (op.lobe >= 0) lobes.insert(op.lobe);
            open.push_back(op.a);
            open.push_back(op.b);
        }
        return lobes;
    }

    /// Light of all lobes under layers whose top holds the closure.
    float beneath(int closure, const std::vector<float>& light) const {
        const auto& ops = _code.bsdf;
        const int lobe = ops[size_t(closure)].lobe;
        if (lobe < 0) return 0.0f;
        std::set<int> under;
        for (const ClosureOp& op : ops)
            if (op.kind == ClosureKind::Layer && op.a >= 0 && op.b >= 0 &&
                lobesOf(op.a).count(lobe))
                under.merge(lobesOf(op.b));
        float sum = 0.0f;
        for (int other : under)
            sum += light[size_t(other)];
        return sum;
    }

    const ProgramCode& _code;
};

} // namespace

std::vector<std::vector<DirectionProbe>> probeProgram(const ProgramCode& code) {
    if (code.bsdf.empty()) return {};
    return ProgramProber(code).run();
}

} // namespace patina
