#include "materialNetwork/glsl/glslClosures.h"

namespace patina {

namespace {

std::string number(int i) {
    return std::to_string(i);
}

void line(std::string& text, const std::string& more) {
    text += more + "\n";
}

} // namespace

std::string glslLinearClosure(const std::vector<ClosureOp>& ops, const std::string& prefix,
                              const GlslRegister& reg, std::string& result) {
    std::string text;

    const int count = int(ops.size());
    const auto of = [&](int i) { return i < 0 ? "vec3(0.0)" : prefix + number(i); };
    for (int i = 0; i < count; ++i) {
        const ClosureOp& op = ops[size_t(i)];
        std::string value;
        switch (op.kind) {
        case ClosureKind::Mix:
            value = "mix(" + of(op.b) + ", " + of(op.a) + ", unit(" + reg(op.factor) + ".x))";
            break;
        case ClosureKind::Add: value = of(op.a) + " + " + of(op.b); break;
        case ClosureKind::Multiply:
            value = of(op.a) + " * emitted(" + reg(op.factor) + ".xyz)";
            break;
        case ClosureKind::ConicalEdf: {
            value = "emitted(" + reg(op.factor) + ".xyz) * edfConical(";
            value += reg(op.first) + ".x, ";
            value += reg(op.second) + ".x, abs(dot(wo, ";
            value += op.normal >= 0 ? "unitOr(" + reg(op.normal) + ".xyz, point.normal)"
                                    : std::string("point.normal");
            value += ")))";
            break;
        }
        case ClosureKind::SchlickEdf:
            value = of(op.a) + " * edfSchlick(" + reg(op.factor) + ".xyz, ";
            value += reg(op.first) + ".xyz, ";
            value += reg(op.second) + ".x, dot(wo, point.normal))";
            break;
        default: value = reg(op.factor) + ".xyz";
        }
        line(text, "    vec3 " + of(i) + " = emitted(" + value + ");");
    }
    result = of(count - 1);
    return text;
}

std::string glslVdf(const std::vector<ClosureOp>& ops, const GlslRegister& reg) {
    std::string text;
    const int count = int(ops.size());
    for (int i = 0; i < count; ++i)
        line(text, "    vec3 v" + number(i) + " = vec3(" + (i == count - 1 ? "1.0" : "0.0") + ");");
    for (int i = count - 1; i >= 0; --i) {
        const ClosureOp& op = ops[size_t(i)];
        const std::string v = "v" + number(i);
        const auto give = [&](int to, const std::string& what) {
            if (to >= 0) line(text, "    v" + number(to) + " += " + what + ";");
        };
        switch (op.kind) {
        case ClosureKind::Mix: {
            const std::string share = "unit(" + reg(op.factor) + ".x)";
            give(op.a, v + " * " + share);
            give(op.b, v + " * (1.0 - " + share + ")");
            break;
        }
        case ClosureKind::Add:
            give(op.a, v);
            give(op.b, v);
            break;
        case ClosureKind::Multiply:
            give(op.a, v + " * coefficient(" + reg(op.factor) + ".xyz)");
            break;
        case ClosureKind::AnisotropicVdf:
            line(text, "    addVdf(m, " + v + ", " + reg(op.factor) + ".xyz, " +
                           reg(op.scattering) + ".xyz, " + reg(op.anisotropy) + ".x);");
            break;
        case ClosureKind::AbsorptionVdf:
            line(text, "    addVdf(m, " + v + ", " + reg(op.factor) + ".xyz, vec3(0.0), 0.0);");
            break;
        default: break;
        }
    }
    return text;
}

} // namespace patina
