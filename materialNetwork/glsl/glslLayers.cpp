// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslLayers.h"

#include "materialNetwork/ir/lobeFacts.h"
#include "materialNetwork/glsl/glslScattering.h"

namespace patina {

namespace {

std::string digits(int i) {
    return std::to_string(i);
}

class LobeText : public ClosureText {
public:
    LobeText(const MaterialIr& code, const GlslRegister& registers)
        : ClosureText(registers, "w"), _code(code) {
        for (size_t i = 0; code.returnsLight && i < code.lobes.size(); ++i)
            line("vec3 kinds" + digits(int(i)) + " = layerKinds(" + alpha(int(i)) + ", " +
                 cosine(int(i)) + ", " + passes(int(i)) + ");");
    }

    static std::string coverage(int lobe) { return "coverage" + digits(lobe); }
    static std::string albedo(int lobe) { return "lobeAlbedo[" + digits(lobe) + "]"; }
    static std::string kinds(int lobe) { return "kinds" + digits(lobe); }
    std::string cosine(int lobe) const { return glslFrameOf(_code, size_t(lobe)) + ".wo.z"; }
    std::string alpha(int lobe) const {
        return lobeFactsOf(kind(lobe)).roughness ? "lobeRoughness(lobe" + digits(lobe) + ")"
                                                 : "1.0";
    }
    std::string inside(int lobe) const {
        const std::string name = "lobe" + digits(lobe);
        const bool dielectric = kind(lobe) == LobeKind::Dielectric;
        return (dielectric ? "layerInsideDielectric(" : "layerInside(") + name + ".favg, " +
               (dielectric ? name + ".ior, " : "") + name + ".invIor, " + cosine(lobe) + ")";
    }
    static bool meets(const std::string&) { return true; }

    void setWeight(int lobe, const std::string& weight) {
        line("lobeWeight[" + digits(lobe) + "] = " + weight + ";");
    }
    // Walks are for the path tracer alone.
    static bool walks(const ClosureOp&) { return false; }
    static void setWalked(const std::string&, const std::string&, int) {}

private:
    LobeKind kind(int lobe) const { return _code.lobes[size_t(lobe)].kind; }

    std::string passes(int lobe) const {
        const LobeTemplate& t = _code.lobes[size_t(lobe)];
        if (t.passThrough || lobeHas(kind(lobe), lobe::Transmits)) return "1.0";
        if (!lobeHas(kind(lobe), lobe::Interface) || t.mode == sh::SCATTER_R) return "0.0";
        return t.mode == sh::SCATTER_T
                   ? "1.0"
                   : "lobePasses(lobe" + digits(lobe) + ", " + cosine(lobe) + ")";
    }

    const MaterialIr& _code;
};

} // namespace

std::string glslWeights(const MaterialIr& code, const GlslRegister& registers) {
    if (code.bsdf.empty()) return "";
    LobeText text(code, registers);
    weighLobes(code, int(code.bsdf.size()) - 1, text);
    return text.text();
}

std::string glslCoverage(const MaterialIr& code, const std::string& fixed) {
    const GlslRegister none;
    ClosureText text(none, "");
    return coverOf(code.layerTransmittance, fixed, text);
}

} // namespace patina
