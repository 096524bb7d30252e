#include "materialNetwork/cpu/bsdfBuilder.h"

#include "materialNetwork/cpu/layerWalk.h"
#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/cpu/microsurface.h"
#include "materialNetwork/cpu/scratch.h"
#include "materialNetwork/cpu/shadingFrame.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

float largest(const glm::vec4& c) {
    return std::max(c.x, std::max(c.y, c.z));
}
float unit(float x) {
    return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
}

glm::vec3 unit(const glm::vec3& c) {
    return {unit(c.x), unit(c.y), unit(c.z)};
}

/// One number or three for what a coloured share takes from a base.
glm::vec3 shareOf(const ProgramCode& code, const glm::vec3& c) {
    switch (code.layerTransmittance) {
    case LayerTransmittance::Returned: // a factor is a tint
    case LayerTransmittance::Largest: return glm::vec3(unit(largest(glm::vec4(c, 0.0f))));
    case LayerTransmittance::Average: return glm::vec3(unit((c.x + c.y + c.z) / 3.0f));
    default: return unit(c);
    }
}

/// How much of a closure there is that is multiplied by a colour.
glm::vec3 coverOf(const ProgramCode& code, const glm::vec4& c) {
    return shareOf(code, glm::vec3(c));
}

/// @param coverage what lobeFixWo() says
glm::vec3 baseCoverage(const ProgramCode& code, const BsdfLobe& l, const glm::vec3& coverage) {
    if (code.layerTransmittance == LayerTransmittance::Returned) return unit(coverage);
    if (code.layerTransmittance != LayerTransmittance::Tinted) return shareOf(code, coverage);
    const bool tinted = lobeHas(l.kind, lobe::Covers) && !lobeTransmits(l);
    return unit(tinted ? l.albedo : coverage);
}

/// Authored factors: negative and NaN count as 0, huge ones as COLOR_MAX.
glm::vec3 factor(const glm::vec4& c) {
    return sh::lobeColor(glm::vec3(c));
}

/// Emission, which may be far brighter than a colour.
glm::vec3 emitted(const glm::vec3& c) {
    return sh::min(sh::max(c, glm::vec3(0.0f)), glm::vec3(sh::EMISSION_MAX));
}

} // namespace

void BsdfBuilder::build(const ProgramCode& code, const ShadingPoint& point,
                        const glm::vec4* registers, Bsdf& out) {
    ThinSlab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, out);
    if (code.lobes.empty()) return;
    if (code.walkedLayers > 0) {
        const auto layered = std::make_shared<LayeredPoint>(&code, point);
        layered->registers.assign(registers, registers + code.registerCount);
        out._layers = layered;
    }
    if (code.hasPassThrough) {
        // The surface is only met with the chance that light does not pass straight.
        const float met = 1.0f - largest(glm::vec4(passThroughWeight(code, slabs, out), 0.0f));
        const float scale = met > 0.0f ? 1.0f / met : 0.0f;
        for (size_t i = 0; i < code.lobes.size() + size_t(code.walkedLayers); ++i)
            out._lobes[i].weight *= i < code.lobes.size() && code.lobes[i].passThrough
                                        ? slabs[i].reflected * scale
                                        : glm::vec3(scale);
    }
    setSelectionPdfs(code, out);
}

void BsdfBuilder::assemble(const ProgramCode& code, const ShadingPoint& point,
                           const glm::vec4* registers, Bsdf& out) {
    ThinSlab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, out);
    for (size_t i = 0; i < code.lobes.size(); ++i)
        if (code.lobes[i].passThrough) out._lobes[i].weight *= slabs[i].reflected;
    out._lobeCount = int(code.lobes.size());
}

void BsdfBuilder::buildPart(const LayeredPoint& layered, int op, const glm::vec3& view, Bsdf& out) {
    ShadingPoint point = layered.point;
    point.viewDirection = view;
    ThinSlab slabs[Bsdf::maxLobes];
    instantiate(*layered.code, point, layered.registers.data(), op, slabs, out);
    out._layers = layered.shared_from_this();
    setSelectionPdfs(*layered.code, out);
}

glm::vec3 BsdfBuilder::passThrough(const ProgramCode& code, const ShadingPoint& point,
                                   const glm::vec4* registers) {
    Bsdf bsdf;
    ThinSlab slabs[Bsdf::maxLobes];
    instantiate(code, point, registers, int(code.bsdf.size()) - 1, slabs, bsdf);
    return passThroughWeight(code, slabs, bsdf);
}

glm::vec3 BsdfBuilder::passThroughWeight(const ProgramCode& code, const ThinSlab* slabs,
                                         const Bsdf& bsdf) {
    glm::vec3 sum(0.0f);
    for (size_t i = 0; i < code.lobes.size(); ++i)
        if (code.lobes[i].passThrough) sum += bsdf._lobes[i].weight * slabs[i].transmittance;
    return {unit(sum.x), unit(sum.y), unit(sum.z)};
}

/// Both faces of the slab reflect: light bounces between them, and the sums of the series are what
/// passes and what comes back. Of a lobe beneath a reflecting one all passes, for that has taken
/// its share. Roughness blurs the reflection only.
template <class Interface>
BsdfBuilder::ThinSlab BsdfBuilder::slabOf(BsdfLobe& lobe, Interface& interface,
                                          const glm::vec3& tint, const glm::vec3& wo,
                                          bool twoFaces) {
    ThinSlab slab;
    const glm::vec3 once = interface.sharedInterface ? glm::vec3(0.0f) : lobeEnergy(lobe, wo).r;
    const glm::vec3 bounces = twoFaces ? once : glm::vec3(0.0f);
    slab.transmittance = tint * (1.0f - once) / (1.0f + bounces);
    slab.reflected = glm::vec3(0.0f);
    if (interface.mode == sh::SCATTER_RT) {
        slab.reflected = (twoFaces ? 2.0f : 1.0f) / (1.0f + bounces);
        interface.mode = sh::SCATTER_R;
        lobe.albedo = tint * once;
    }
    return slab;
}

void BsdfBuilder::instantiate(const ProgramCode& code, const ShadingPoint& point,
                              const glm::vec4* registers, int root, ThinSlab* slabs, Bsdf& out) {
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
    for (size_t i = 0; i < code.frames.size(); ++i) {
        const FrameTemplate& f = code.frames[i];
        glm::vec3 n, t;
        if (f.normal >= 0) n = glm::vec3(registers[f.normal]);
        if (f.tangent >= 0) t = glm::vec3(registers[f.tangent]);
        out._frames[i] =
            makeFrame(point, f.normal >= 0 ? &n : nullptr, f.tangent >= 0 ? &t : nullptr, f.flips);
    }
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
        if (t.constant) {
            l = t.prebuilt;
        } else {
            l.kind = t.prebuilt.kind;
            l.diffuse = t.prebuilt.diffuse;
            l.frame = t.prebuilt.frame;
            setupLobe(t, registers, l);
        }
        l.stochastic = t.walks && canWalkMicrosurface(l);
        l.weight = glm::vec3(0.0f);
        l.albedo = glm::vec3(0.0f);
        if (registers[t.weight].x > 0.0f)
            coverage[i] = baseCoverage(code, l, lobeFixWo(l, out._frames[l.frame].wo, t.energy));
        if (!t.passThrough) continue;
        const glm::vec3& wo = out._frames[l.frame].wo;
        slabs[i] = l.kind == LobeKind::Dielectric
                       ? slabOf(l, l.dielectric, l.dielectric.tint, wo, code.slabsHaveTwoFaces)
                       : slabOf(l, l.schlick, glm::vec3(1.0f), wo, code.slabsHaveTwoFaces);
    }
    if (code.returnsLight)
        setReturnedWeights(code, registers, coverage, root, out);
    else
        setWeights(code, registers, coverage, root, out);
}

/// A walked layer stands among the lobes. How much it reflects, to choose it by, is what albedo
/// scaling says.
void BsdfBuilder::setLayer(const ProgramCode& code, const glm::vec3& weight, int op, int index,
                           Bsdf& out) {
    const ClosureOp& layer = code.bsdf[size_t(op)];
    const BsdfLobe& top = out._lobes[code.bsdf[size_t(layer.a)].lobe];
    const uint32_t base = code.bsdf[size_t(layer.b)].lobes;
    BsdfLobe& l = out._lobes[index];
    l.kind = LobeKind::Layered;
    l.diffuse = false;
    l.stochastic = true;
    l.frame = top.frame;
    l.weight = weight;
    l.layered = {op, false};
    glm::vec3 beneath(0.0f);
    int count = 0;
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        if ((base & (1u << i)) == 0) continue;
        beneath += out._lobes[i].albedo;
        ++count;
        l.layered.transmits |= lobeTransmits(out._lobes[i]);
    }
    l.albedo = top.albedo + (1.0f - unit(top.albedo)) * beneath / float(std::max(count, 1));
}

void BsdfBuilder::setWeights(const ProgramCode& code, const glm::vec4* registers,
                             const glm::vec3* coverage, int root, Bsdf& out) {
    const int n = root + 1;
    // Upwards: what the tops of layers let through.
    Scratch<glm::vec3> transmittance(size_t(n) + 1);
    const auto transmittanceOf = [&](int i) { return i < 0 ? glm::vec3(1.0f) : transmittance[i]; };
    for (int i = 0; i < n; ++i) {
        const ClosureOp& op = code.bsdf[size_t(i)];
        if (!op.needsTransmittance) continue;
        switch (op.kind) {
        case ClosureKind::Layer:
            transmittance[i] = transmittanceOf(op.a) * transmittanceOf(op.b);
            break;
        case ClosureKind::Mix: {
            const float m = unit(registers[op.factor].x);
            transmittance[i] = transmittanceOf(op.a) * m + transmittanceOf(op.b) * (1.0f - m);
            break;
        }
        case ClosureKind::Add:
            transmittance[i] =
                sh::max(transmittanceOf(op.a) + transmittanceOf(op.b) - 1.0f, glm::vec3(0.0f));
            break;
        case ClosureKind::Multiply:
            transmittance[i] =
                1.0f - coverOf(code, registers[op.factor]) * (1.0f - transmittanceOf(op.a));
            break;
        default:
            transmittance[i] = glm::vec3(1.0f);
            if (op.lobe >= 0) transmittance[i] -= unit(registers[op.factor].x) * coverage[op.lobe];
        }
    }
    // Downwards: a closure's weight is the sum over the wholes it is part of.
    Scratch<glm::vec3, 1> weight(size_t(n) + 1);
    for (int i = 0; i < n; ++i)
        weight[i] = glm::vec3(0.0f);
    weight[n - 1] = glm::vec3(1.0f);
    const int lobes = int(code.lobes.size());
    for (int i = 0; i < code.walkedLayers; ++i)
        out._lobes[lobes + i].weight = glm::vec3(0.0f);
    int layers = 0;
    for (int i = n - 1; i >= 0; --i) {
        const ClosureOp& op = code.bsdf[size_t(i)];
        const glm::vec3 w = weight[i];
        switch (op.kind) {
        case ClosureKind::Layer:
            if (op.walked) {
                // The top covers the base by its weight.
                const float covers = unit(registers[code.bsdf[size_t(op.a)].factor].x);
                if (w != glm::vec3(0.0f) && covers > 0.0f)
                    setLayer(code, w * covers, i, lobes + layers++, out);
                weight[op.b] += w * (1.0f - covers);
                break;
            }
            weight[op.a] += w;
            weight[op.b] += w * transmittance[op.a];
            break;
        case ClosureKind::Mix: {
            const float m = unit(registers[op.factor].x);
            if (op.a >= 0) weight[op.a] += w * m;
            if (op.b >= 0) weight[op.b] += w * (1.0f - m);
            break;
        }
        case ClosureKind::Add:
            if (op.a >= 0) weight[op.a] += w;
            if (op.b >= 0) weight[op.b] += w;
            break;
        case ClosureKind::Multiply: weight[op.a] += w * factor(registers[op.factor]); break;
        default:
            if (op.lobe >= 0) out._lobes[op.lobe].weight = w * unit(registers[op.factor].x);
        }
    }
}

void BsdfBuilder::setSelectionPdfs(const ProgramCode& code, Bsdf& out) {
    int count = 0;
    for (int i = 0; i < int(code.lobes.size()) + code.walkedLayers; ++i) {
        if (!(luminance(out._lobes[i].weight) > 0.0f)) continue;
        if (count != i) out._lobes[count] = out._lobes[i];
        ++count;
    }
    float sum = 0.0f;
    for (int i = 0; i < count; ++i) {
        BsdfLobe& l = out._lobes[i];
        // A lone lobe needs no share.
        l.probability = count == 1 ? 1.0f : luminance(l.weight * l.albedo);
        sum += l.probability;
        out._transmits |= lobeTransmits(l);
        out._nonDelta |= lobeNonDelta(l);
        out._stochastic |= l.stochastic;
    }
    if (!(sum > 0.0f)) {
        out._nonDelta = false;
        return;
    }
    // Lobes whose albedo is 0 at wo (below their horizon) are never drawn, and evaluate to 0.
    for (int i = 0; i < count; ++i)
        out._lobes[i].probability /= sum;
    out._lobeCount = count;
}

namespace {

glm::vec3 normalOf(const ClosureOp& op, const glm::vec4* registers, const glm::vec3& normal) {
    if (op.normal < 0) return normal;
    const glm::vec3 n(registers[op.normal]);
    const float length = glm::length(n);
    return length > 0.0f ? n / length : normal;
}

/// The axis is the normal, and the azimuth begins at the tangent.
float measured(const EmissionProfile& profile, const glm::vec3& wo, const glm::vec3& n,
               const glm::vec3& tangent) {
    glm::vec3 x = tangent - n * glm::dot(tangent, n), y;
    const float length = glm::length(x);
    if (length > 1e-6f) {
        x /= length;
        y = glm::cross(n, x);
    } else {
        completeBasis(n, x, y);
    }
    const float z = std::min(std::fabs(glm::dot(wo, n)), 1.0f);
    const float amount = profile.factor(std::acos(z), std::atan2(glm::dot(wo, y), glm::dot(wo, x)));
    return amount > 0.0f ? amount : 0.0f;
}

} // namespace

glm::vec3 linearClosure(const std::vector<ClosureOp>& ops, const glm::vec4* registers,
                        const glm::vec3& wo, const glm::vec3& normal, const glm::vec3& tangent) {
    const int n = int(ops.size());
    if (n == 0) return glm::vec3(0.0f);
    Scratch<glm::vec3> value(size_t(n) + 1);
    const auto of = [&](int i) { return i < 0 ? glm::vec3(0.0f) : value[i]; };
    for (int i = 0; i < n; ++i) {
        const ClosureOp& op = ops[size_t(i)];
        switch (op.kind) {
        case ClosureKind::Mix: {
            const float m = unit(registers[op.factor].x);
            value[i] = of(op.a) * m + of(op.b) * (1.0f - m);
            break;
        }
        case ClosureKind::Add: value[i] = of(op.a) + of(op.b); break;
        case ClosureKind::Multiply:
            value[i] = of(op.a) * emitted(glm::vec3(registers[op.factor]));
            break;
        // Both sides emit alike.
        case ClosureKind::ConicalEdf: {
            const glm::vec3 n = normalOf(op, registers, normal);
            value[i] = emitted(glm::vec3(registers[op.factor])) *
                       sh::edfConical(registers[op.first].x, registers[op.second].x,
                                      std::fabs(glm::dot(wo, n)));
            break;
        }
        case ClosureKind::MeasuredEdf:
            value[i] = emitted(glm::vec3(registers[op.factor]));
            if (op.profile)
                value[i] *= measured(*op.profile, wo, normalOf(op, registers, normal), tangent);
            break;
        case ClosureKind::SchlickEdf:
            value[i] = of(op.a) * sh::edfSchlick(glm::vec3(registers[op.factor]),
                                                 glm::vec3(registers[op.first]),
                                                 registers[op.second].x, glm::dot(wo, normal));
            break;
        default: value[i] = glm::vec3(registers[op.factor]);
        }
        value[i] = emitted(value[i]);
    }
    return value[n - 1];
}

} // namespace patina
