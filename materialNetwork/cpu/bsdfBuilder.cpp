// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/bsdfBuilder.h"

#include "materialNetwork/cpu/layerWalk.h"
#include "materialNetwork/ir/layerWeights.h"
#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/cpu/microsurface.h"
#include "materialNetwork/cpu/shadingFrame.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

const EnergyCurve unknownEnergy; ///< of a lobe that is not as its program keeps it

} // namespace

void BsdfBuilder::build(const ProgramCode& code, const ShadingPoint& point,
                        const glm::vec4* registers, Bsdf& out) {
    sh::Slab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, out);
    if (code.lobes.empty()) return;
    if (code.walkedLayers > 0) {
        const auto layered = std::make_shared<LayeredPoint>(&code, point);
        layered->registers.assign(registers, registers + code.registerCount);
        out._layers = layered;
    }
    if (code.hasPassThrough) {
        const float scale = sh::slabScale(passThroughWeight(code, slabs, out));
        for (size_t i = 0; i < code.lobes.size() + size_t(code.walkedLayers); ++i)
            out._lobes[i].weight *= i < code.lobes.size() && code.lobes[i].passThrough
                                        ? slabs[i].reflected * scale
                                        : glm::vec3(scale);
    }
    setSelectionPdfs(code, out);
}

void BsdfBuilder::assemble(const ProgramCode& code, const ShadingPoint& point,
                           const glm::vec4* registers, Bsdf& out) {
    sh::Slab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, out);
    for (size_t i = 0; i < code.lobes.size(); ++i)
        if (code.lobes[i].passThrough) out._lobes[i].weight *= slabs[i].reflected;
    out._lobeCount = int(code.lobes.size());
}

void BsdfBuilder::buildPart(const LayeredPoint& layered, int op, const glm::vec3& view, Bsdf& out) {
    ShadingPoint point = layered.point;
    point.viewDirection = view;
    sh::Slab slabs[Bsdf::maxLobes];
    instantiate(*layered.code, point, layered.registers.data(), op, slabs, out);
    out._layers = layered.shared_from_this();
    setSelectionPdfs(*layered.code, out);
}

glm::vec3 BsdfBuilder::passThrough(const ProgramCode& code, const ShadingPoint& point,
                                   const glm::vec4* registers) {
    Bsdf bsdf;
    sh::Slab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, bsdf);
    return passThroughWeight(code, slabs, bsdf);
}

glm::vec3 BsdfBuilder::passThroughWeight(const ProgramCode& code, const sh::Slab* slabs,
                                         const Bsdf& bsdf) {
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < code.lobes.size(); ++i)
        if (code.lobes[i].passThrough) sum += bsdf._lobes[i].weight * slabs[i].transmittance;
    return sh::unitColor(sum);
}

void BsdfBuilder::instantiate(const ProgramCode& code, const ShadingPoint& point,
                              const glm::vec4* registers, int root, sh::Slab* slabs, Bsdf& out) {
    out._lobeCount = 0;
    out._nonDelta = false;
    out._transmits = false;
    out._walks = false;
    out._stochastic = false;
    out._seed = 0;
    out._layers.reset();
    out._geometricNormal = point.geometricNormal;
    out._view = point.viewDirection;
    out._woOutside = glm::dot(point.viewDirection, point.geometricNormal) >= 0.0f;
    if (code.lobes.empty()) return;
    for (size_t i = 0; i < code.frames.size(); ++i)
        out._frames[i] = makeFrame(code.frames[i], registers, point);
    ClosureNumbers numbers(registers);
    glm::vec3 coverage[Bsdf::maxLobes];
    const uint32_t part = code.bsdf[size_t(root)].lobes;
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const LobeTemplate& t = code.lobes[i];
        coverage[i] = glm::vec3(0.0f);
        BsdfLobe& l = out._lobes[i];
        if ((part & (1u << i)) == 0) {
            l.weight = glm::vec3(0.0f);
            continue;
        }
        const bool isKept = setupLobeAt(code, i, registers, point, l);
        l.place = uint8_t(i);
        l.stochastic = t.walks && canWalkMicrosurface(l);
        l.weight = glm::vec3(0.0f);
        l.albedo = glm::vec3(0.0f);
        if (registers[t.weight].x > 0.0f) {
            const glm::vec3 fixed =
                lobeFixWo(l, out._frames[l.frame].wo, isKept ? t.energy : unknownEnergy);
            const bool tinted = code.layerTransmittance == LayerTransmittance::Tinted &&
                                lobeHas(l.kind, lobe::Covers) && !lobeTransmits(l);
            coverage[i] = coverOf(code.layerTransmittance, tinted ? l.albedo : fixed, numbers);
        }
        if (!t.passThrough) continue;
        const glm::vec3& wo = out._frames[l.frame].wo;
        slabs[i] = l.kind == LobeKind::Dielectric
                       ? sh::dielectricSlab(l.dielectric, wo, l.albedo, code.slabsHaveTwoFaces)
                       : sh::schlickSlab(l.schlick, wo, l.albedo, code.slabsHaveTwoFaces);
    }
    setWeights(code, registers, coverage, root, out);
}

void BsdfBuilder::setSelectionPdfs(const ProgramCode& code, Bsdf& out) {
    int count = 0;
    for (int i = 0; i < int(code.lobes.size()) + code.walkedLayers; ++i) {
        if (!sh::hasWeight(out._lobes[i].weight)) continue;
        if (count != i) out._lobes[count] = out._lobes[i];
        ++count;
    }
    float sum = 0.0f;
    for (int i = 0; i < count; ++i) {
        BsdfLobe& l = out._lobes[i];
        l.probability = sh::selectionShare(l.weight, l.albedo, count == 1);
        sum += l.probability;
        out._transmits |= lobeTransmits(l);
        out._nonDelta |= lobeNonDelta(l);
        out._stochastic |= l.stochastic;
    }
    if (!(sum > 0.0f)) {
        out._nonDelta = false;
        return;
    }
    for (int i = 0; i < count; ++i)
        out._lobes[i].probability /= sum;
    out._lobeCount = count;
}

namespace {

/// Emission along one direction.
class EmissionNumbers : public ClosureNumbers {
public:
    EmissionNumbers(const glm::vec4* registers, const glm::vec3& wo, const glm::vec3& normal,
                    const glm::vec3& tangent)
        : ClosureNumbers(registers), _wo(wo), _normal(normal), _tangent(tangent) {}

    const glm::vec3& wo() const { return _wo; }
    const glm::vec3& normal() const { return _normal; }
    static bool hasProfile(const ClosureOp& op) { return op.profile != nullptr; }
    float profile(const ClosureOp& op, const glm::vec3& axis) const {
        const float z = std::min(std::fabs(glm::dot(_wo, axis)), 1.0f);
        const glm::vec2 around = sh::azimuthOf(_wo, axis, _tangent);
        const float amount = op.profile->factor(std::acos(z), std::atan2(around.y, around.x));
        return amount > 0.0f ? amount : 0.0f;
    }

private:
    const glm::vec3 &_wo, &_normal, &_tangent;
};

} // namespace

glm::vec3 linearClosure(const std::vector<ClosureOp>& ops, const glm::vec4* registers,
                        const glm::vec3& wo, const glm::vec3& normal, const glm::vec3& tangent) {
    EmissionNumbers numbers(registers, wo, normal, tangent);
    return emissionOf(ops, numbers);
}

} // namespace patina
