#include "materialNetwork/glsl/glslLayers.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/lobeFacts.h"
#include "materialNetwork/glsl/glslScattering.h"

namespace patina {

namespace {

std::string number(int i) {
    return std::to_string(i);
}

class Writer {
public:
    Writer(const ProgramCode& code, const std::vector<std::string>& factors)
        : _code(code), _factors(factors) {}

    std::string write() {
        for (size_t i = 0; i < _code.lobes.size(); ++i)
            kinds(int(i));
        const int n = int(_code.bsdf.size());
        for (int i = 0; i < n; ++i)
            light(i);
        for (int i = 0; i < n; ++i)
            line("LayerLight w" + number(i) + " = layerEven(vec3(" + (i == n - 1 ? "1.0" : "0.0") +
                 "));");
        for (int i = n - 1; i >= 0; --i)
            weight(i);
        return _text;
    }

private:
    void line(const std::string& text) { _text += "    " + text + "\n"; }

    std::string cosineOf(int lobe) const { return glslFrameOf(_code, size_t(lobe)) + ".wo.z"; }

    static std::string alphaOf(LobeKind kind, const std::string& lobe) {
        return lobeFactsOf(kind).roughness ? "lobeRoughness(" + lobe + ")" : "1.0";
    }

    std::string passesOf(const LobeTemplate& t, const std::string& lobe,
                         const std::string& z) const {
        const LobeKind kind = t.prebuilt.kind;
        if (t.passThrough || lobeHas(kind, lobe::Transmits)) return "1.0";
        if (!lobeHas(kind, lobe::Interface) || t.mode == sh::SCATTER_R) return "0.0";
        return t.mode == sh::SCATTER_T ? "1.0" : "lobePasses(" + lobe + ", " + z + ")";
    }

    void kinds(int i) {
        const LobeTemplate& t = _code.lobes[size_t(i)];
        const std::string lobe = "lobe" + number(i), z = cosineOf(i);
        line("vec3 kinds" + number(i) + " = layerKinds(" + alphaOf(t.prebuilt.kind, lobe) + ", " +
             z + ", " + passesOf(t, lobe, z) + ");");
    }

    std::string lightOf(int i) const {
        return i < 0 ? "layerEven(vec3(0.0))" : "light" + number(i);
    }

    /// The name of what a top lets through.
    std::string through(int top, const std::string& base, bool returns) {
        if (top < 0) return "layerEven(vec3(1.0))";
        const ClosureOp& op = _code.bsdf[size_t(top)];
        const std::string& f = _factors[size_t(top)];
        std::string value = "layerEven(vec3(1.0))";
        switch (op.kind) {
        case ClosureKind::Layer: {
            const std::string lower = through(op.b, base, returns);
            const std::string below =
                named("layerSum(" + lightOf(op.b) + ", layerProduct(" + lower + ", " + base + "))");
            value = "layerProduct(" + through(op.a, below, returns) + ", " + lower + ")";
            break;
        }
        case ClosureKind::Mix: {
            const std::string a = through(op.a, base, returns), b = through(op.b, base, returns);
            value = "layerMix(" + a + ", " + b + ", " + f + ")";
            break;
        }
        case ClosureKind::Add: {
            const std::string a = through(op.a, base, returns), b = through(op.b, base, returns);
            value = "layerBeside(" + a + ", " + b + ")";
            break;
        }
        case ClosureKind::Multiply:
            value = "layerCovered(" + through(op.a, base, returns) + ", shareLargest(" + f + "))";
            break;
        default:
            if (op.lobe >= 0) value = past(op, f, base, returns);
        }
        return named(value);
    }

    std::string past(const ClosureOp& op, const std::string& cover, const std::string& base,
                     bool returns) const {
        const LobeTemplate& t = _code.lobes[size_t(op.lobe)];
        const std::string n = number(op.lobe), lobe = "lobe" + n;
        if (!returns || !isReturning(t)) return "layerPast(" + cover + ", coverage" + n + ")";
        const LobeKind kind = t.prebuilt.kind;
        const std::string z = cosineOf(op.lobe);
        const std::string inside =
            std::string(kind == LobeKind::Dielectric ? "layerInsideDielectric(" : "layerInside(") +
            lobe + ".favg, " + (kind == LobeKind::Dielectric ? lobe + ".ior, " : "") + lobe +
            ".invIor, " + z + ")";
        return "layerThrough(" + cover + ", coverage" + n + ", " + inside + ", " +
               alphaOf(kind, lobe) + ", " + z + ", " + base + ")";
    }

    std::string named(const std::string& value) {
        const std::string name = "top" + number(_names++);
        line("LayerLight " + name + " = " + value + ";");
        return name;
    }

    void light(int i) {
        const ClosureOp& op = _code.bsdf[size_t(i)];
        const std::string& f = _factors[size_t(i)];
        std::string value = lightOf(-1);
        switch (op.kind) {
        case ClosureKind::Layer: {
            const std::string transmittance = through(op.a, lightOf(op.b), op.returns);
            line("LayerLight through" + number(i) + " = " + transmittance + ";");
            value = "layerSum(" + lightOf(op.a) + ", layerProduct(" + transmittance + ", " +
                    lightOf(op.b) + "))";
            break;
        }
        case ClosureKind::Mix:
            value = "layerMix(" + lightOf(op.a) + ", " + lightOf(op.b) + ", " + f + ")";
            break;
        case ClosureKind::Add:
            value = "layerSum(" + lightOf(op.a) + ", " + lightOf(op.b) + ")";
            break;
        case ClosureKind::Multiply:
            value = "layerScaled(" + lightOf(op.a) + ", factor(" + f + "))";
            break;
        default: {
            const std::string n = number(op.lobe);
            if (op.lobe >= 0)
                value = "layerOfLobe(lobeAlbedo[" + n + "] * " + f + ", kinds" + n + ")";
        }
        }
        line("LayerLight light" + number(i) + " = " + value + ";");
    }

    void weight(int i) {
        const ClosureOp& op = _code.bsdf[size_t(i)];
        const std::string w = "w" + number(i);
        const std::string& f = _factors[size_t(i)];
        const auto give = [&](int to, const std::string& what) {
            if (to >= 0) line("w" + number(to) + " = layerSum(w" + number(to) + ", " + what + ");");
        };
        switch (op.kind) {
        case ClosureKind::Layer:
            give(op.a, w);
            give(op.b, "layerProduct(" + w + ", through" + number(i) + ")");
            break;
        case ClosureKind::Mix:
            give(op.a, "layerScaled(" + w + ", vec3(" + f + "))");
            give(op.b, "layerScaled(" + w + ", vec3(1.0 - " + f + "))");
            break;
        case ClosureKind::Add:
            give(op.a, w);
            give(op.b, w);
            break;
        case ClosureKind::Multiply: give(op.a, "layerScaled(" + w + ", factor(" + f + "))"); break;
        default:
            if (op.lobe >= 0)
                line("lobeWeight[" + number(op.lobe) + "] = layerWeight(" + w + ", kinds" +
                     number(op.lobe) + ") * " + f + ";");
        }
    }

    const ProgramCode& _code;
    const std::vector<std::string>& _factors;
    std::string _text;
    int _names = 0;
};

} // namespace

std::string glslReturnedWeights(const ProgramCode& code, const std::vector<std::string>& factors) {
    return Writer(code, factors).write();
}

} // namespace patina
