// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/ir/layerWeights.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/lobeOps.h"

#include <algorithm>

namespace patina {

/// The lobes of a Bsdf that is being built, and what they are weighed by.
class BsdfBuilder::LobeNumbers : public ClosureNumbers {
public:
    LobeNumbers(const ProgramCode& code, const glm::vec4* registers, const glm::vec3* coverage,
                uint32_t part, Bsdf& out)
        : ClosureNumbers(registers), _code(code), _coverage(coverage), _out(out) {
        for (int i = 0; i < code.walkedLayers; ++i)
            out._lobes[int(code.lobes.size()) + i].weight = glm::vec3(0.0f);
        for (int i = 0; code.returnsLight && i < int(code.lobes.size()); ++i) {
            if ((part & (1u << i)) == 0) continue;
            const float passes =
                code.lobes[size_t(i)].passThrough ? 1.0f : lobePasses(out._lobes[i], cosine(i));
            _kinds[i] = sh::layerKinds(alpha(i), cosine(i), passes);
        }
    }

    const glm::vec3& coverage(int lobe) const { return _coverage[lobe]; }
    const glm::vec3& albedo(int lobe) const { return _out._lobes[lobe].albedo; }
    const glm::vec3& kinds(int lobe) const { return _kinds[lobe]; }
    float cosine(int lobe) const { return _out._frames[_out._lobes[lobe].frame].wo.z; }
    float alpha(int lobe) const { return lobeRoughness(_out._lobes[lobe]); }
    glm::vec3 inside(int lobe) const {
        const BsdfLobe& l = _out._lobes[lobe];
        const float z = cosine(lobe);
        if (l.kind == LobeKind::Dielectric)
            return sh::layerInsideDielectric(l.dielectric.favg, l.dielectric.ior,
                                             l.dielectric.invIor, z);
        return sh::layerInside(l.schlick.favg, l.schlick.invIor, z);
    }
    static bool meets(float share) { return share > 0.0f; }

    void setWeight(int lobe, const glm::vec3& weight) { _out._lobes[lobe].weight = weight; }
    static bool walks(const ClosureOp& op) { return op.walked; }
    void setWalked(const sh::LayerLight& w, float covers, int op) {
        setWalked(w.spread, covers, op);
    }
    void setWalked(const glm::vec3& w, float covers, int op) {
        if (w != glm::vec3(0.0f) && covers > 0.0f)
            setLayer(_code, w * covers, op, int(_code.lobes.size()) + _layers++, _out);
    }

private:
    const ProgramCode& _code;
    const glm::vec3* _coverage;
    Bsdf& _out;
    glm::vec3 _kinds[Bsdf::maxLobes];
    int _layers = 0;
};

void BsdfBuilder::setWeights(const ProgramCode& code, const glm::vec4* registers,
                             const glm::vec3* coverage, int root, Bsdf& out) {
    LobeNumbers numbers(code, registers, coverage, code.bsdf[size_t(root)].lobes, out);
    weighLobes(code, root, numbers);
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
    l.place = uint8_t(index);
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
    l.albedo =
        top.albedo + (1.0f - sh::unitColor(top.albedo)) * beneath / float(std::max(count, 1));
}

} // namespace patina
