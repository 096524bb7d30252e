// The weights of lobes where layers count what their tops send back down: shaders/lib/layers.glsl
// over the tree of closures.

#include "materialNetwork/cpu/bsdfBuilder.h"

#include "materialNetwork/cpu/lobeOps.h"
#include "materialNetwork/cpu/scratch.h"

#include "shaders/layers.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

float unit(float x) {
    return x > 0.0f ? (x < 1.0f ? x : 1.0f) : 0.0f;
}

glm::vec3 insideOf(const BsdfLobe& l, float z) {
    if (l.kind == LobeKind::Dielectric)
        return sh::layerInsideDielectric(l.dielectric.favg, l.dielectric.ior, l.dielectric.invIor,
                                         z);
    return sh::layerInside(l.schlick.favg, l.schlick.invIor, z);
}

/// What tops let through, for one base after the other.
class Tops {
public:
    Tops(const ProgramCode& code, const glm::vec4* registers, const glm::vec3* coverage,
         const Bsdf& bsdf, Scratch<sh::LayerLight>& light)
        : _code(code), _registers(registers), _coverage(coverage), _bsdf(bsdf), _light(light) {}

    /// @param base albedo of what lies below; @param returns whether light comes back to it
    sh::LayerLight through(int top, const sh::LayerLight& base, bool returns) {
        if (top < 0) return sh::layerEven(glm::vec3(1.0f));
        const ClosureOp& op = _code.bsdf[size_t(top)];
        switch (op.kind) {
        case ClosureKind::Layer: {
            const sh::LayerLight lower = through(op.b, base, returns);
            const sh::LayerLight below = sh::layerSum(_light[op.b], sh::layerProduct(lower, base));
            return sh::layerProduct(through(op.a, below, returns), lower);
        }
        case ClosureKind::Mix:
            return sh::layerMix(through(op.a, base, returns), through(op.b, base, returns),
                                unit(_registers[op.factor].x));
        case ClosureKind::Add:
            return sh::layerBeside(through(op.a, base, returns), through(op.b, base, returns));
        case ClosureKind::Multiply: {
            const glm::vec4& c = _registers[op.factor];
            return sh::layerCovered(through(op.a, base, returns),
                                    glm::vec3(unit(std::max(c.x, std::max(c.y, c.z)))));
        }
        default: break;
        }
        if (op.lobe < 0) return sh::layerEven(glm::vec3(1.0f));
        const float weight = unit(_registers[op.factor].x);
        const glm::vec3& coverage = _coverage[op.lobe];
        const BsdfLobe& l = _bsdf.lobe(op.lobe);
        if (!returns || !(weight > 0.0f) || !isReturning(_code.lobes[size_t(op.lobe)]))
            return sh::layerPast(weight, coverage);
        const float z = _bsdf.frame(l.frame).wo.z;
        return sh::layerThrough(weight, coverage, insideOf(l, z), lobeRoughness(l), z, base);
    }

private:
    const ProgramCode& _code;
    const glm::vec4* _registers;
    const glm::vec3* _coverage;
    const Bsdf& _bsdf;
    Scratch<sh::LayerLight>& _light;
};

} // namespace

bool isReturning(const LobeTemplate& t) {
    return lobeHas(t.prebuilt.kind, lobe::Interface) && t.mode == sh::SCATTER_R;
}

void BsdfBuilder::setReturnedWeights(const ProgramCode& code, const glm::vec4* registers,
                                     const glm::vec3* coverage, int root, Bsdf& out) {
    const int n = root + 1, lobes = int(code.lobes.size());
    const glm::vec3 none(0.0f);
    const uint32_t part = code.bsdf[size_t(root)].lobes;
    glm::vec3 kinds[Bsdf::maxLobes];
    for (int i = 0; i < lobes; ++i) {
        kinds[i] = none;
        if ((part & (1u << i)) == 0) continue;
        const BsdfLobe& l = out._lobes[i];
        const float z = out._frames[l.frame].wo.z;
        const float passes = code.lobes[size_t(i)].passThrough ? 1.0f : lobePasses(l, z);
        kinds[i] = sh::layerKinds(lobeRoughness(l), z, passes);
    }
    const auto isPart = [&](const ClosureOp& op) {
        return op.lobes != 0 && (op.lobes & ~part) == 0;
    };
    // Upwards: what each closure reflects and passes, and what reaches the bases of layers.
    Scratch<sh::LayerLight> light(size_t(n) + 1);
    Scratch<sh::LayerLight, 1> through(size_t(n) + 1);
    Tops tops(code, registers, coverage, out, light);
    const auto lightOf = [&](int i) { return i < 0 ? sh::layerEven(none) : light[i]; };
    for (int i = 0; i < n; ++i) {
        const ClosureOp& op = code.bsdf[size_t(i)];
        if (!isPart(op)) {
            if (op.beneath) light[i] = sh::layerEven(none);
            continue;
        }
        if (op.kind == ClosureKind::Layer) through[i] = tops.through(op.a, light[op.b], op.returns);
        if (!op.beneath) continue;
        switch (op.kind) {
        case ClosureKind::Layer:
            light[i] = sh::layerSum(light[op.a], sh::layerProduct(through[i], light[op.b]));
            break;
        case ClosureKind::Mix:
            light[i] = sh::layerMix(lightOf(op.a), lightOf(op.b), unit(registers[op.factor].x));
            break;
        case ClosureKind::Add: light[i] = sh::layerSum(lightOf(op.a), lightOf(op.b)); break;
        case ClosureKind::Multiply:
            light[i] = sh::layerScaled(light[op.a], sh::lobeColor(glm::vec3(registers[op.factor])));
            break;
        default: {
            const float share = unit(registers[op.factor].x);
            light[i] = sh::layerOfLobe(out._lobes[op.lobe].albedo * share, kinds[op.lobe]);
        }
        }
    }
    // Downwards: a closure's weight is the sum over the wholes it is part of.
    Scratch<sh::LayerLight, 2> weight(size_t(n) + 1);
    for (int i = 0; i < n; ++i)
        weight[i] = sh::layerEven(none);
    weight[n - 1] = sh::layerEven(glm::vec3(1.0f));
    for (int i = 0; i < code.walkedLayers; ++i)
        out._lobes[lobes + i].weight = none;
    int layers = 0;
    for (int i = n - 1; i >= 0; --i) {
        const ClosureOp& op = code.bsdf[size_t(i)];
        if (!isPart(op)) continue;
        const sh::LayerLight w = weight[i];
        const auto give = [&](int to, const sh::LayerLight& what) {
            if (to >= 0) weight[to] = sh::layerSum(weight[to], what);
        };
        switch (op.kind) {
        case ClosureKind::Layer:
            if (op.walked) {
                // The top covers the base by its weight.
                const float covers = unit(registers[code.bsdf[size_t(op.a)].factor].x);
                if (w.spread != none && covers > 0.0f)
                    setLayer(code, w.spread * covers, i, lobes + layers++, out);
                give(op.b, sh::layerScaled(w, glm::vec3(1.0f - covers)));
                break;
            }
            give(op.a, w);
            give(op.b, sh::layerProduct(w, through[i]));
            break;
        case ClosureKind::Mix: {
            const float m = unit(registers[op.factor].x);
            give(op.a, sh::layerScaled(w, glm::vec3(m)));
            give(op.b, sh::layerScaled(w, glm::vec3(1.0f - m)));
            break;
        }
        case ClosureKind::Add:
            give(op.a, w);
            give(op.b, w);
            break;
        case ClosureKind::Multiply:
            give(op.a, sh::layerScaled(w, sh::lobeColor(glm::vec3(registers[op.factor]))));
            break;
        default:
            out._lobes[op.lobe].weight =
                sh::layerWeight(w, kinds[op.lobe]) * unit(registers[op.factor].x);
        }
    }
}

} // namespace patina
