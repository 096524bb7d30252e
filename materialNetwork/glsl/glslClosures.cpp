#include "materialNetwork/glsl/glslClosures.h"

#include <cmath>

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
                              const GlslRegister& reg,
                              const std::function<std::string(const ClosureOp&)>& profile,
                              std::string& result) {
    std::string text;
    const auto axis = [&](const ClosureOp& op) {
        return op.normal >= 0 ? "unitOr(" + reg(op.normal) + ".xyz, point.normal)"
                              : std::string("point.normal");
    };
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
            value += axis(op) + ")))";
            break;
        }
        case ClosureKind::MeasuredEdf: {
            value = "emitted(" + reg(op.factor) + ".xyz)";
            const std::string name = profile(op);
            if (!name.empty()) value += " * " + name + "(wo, " + axis(op) + ")";
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

GlslProfileTable::GlslProfileTable(const EmissionProfile& profile) : angles(91), turns(25) {
    const float quarter = 1.57079633f;
    std::vector<float> found;
    bool round = true;
    for (int k = 0; k < turns; ++k)
        for (int i = 0; i < angles; ++i) {
            const float amount = profile.factor(quarter * float(i) / float(angles - 1),
                                                4.0f * quarter * float(k) / float(turns - 1));
            found.push_back(amount > 0.0f ? amount : 0.0f);
            round &= std::fabs(found.back() - found[size_t(i)]) <= 1e-4f * found[size_t(i)];
        }
    if (round) {
        turns = 1;
        found.resize(size_t(angles));
    }
    values.assign((found.size() + 3) / 4, glm::vec4(0.0f));
    for (size_t i = 0; i < found.size(); ++i)
        values[i / 4][int(i % 4)] = found[i];
}

std::string glslProfile(const std::string& name, const GlslProfileTable& table, size_t first) {
    const std::string angles = number(table.angles), steps = number(table.angles - 1) + ".0";
    std::string text;
    line(text, "float " + name + "At(int i) {");
    line(text, "    return materialParameter(" + number(int(first)) + " + i / 4)[i % 4];");
    line(text, "}");
    line(text, "float " + name + "(vec3 wo, vec3 n) {");
    line(text, "    float t = acos(min(abs(dot(wo, n)), 1.0)) * 0.636619772 * " + steps + ";");
    line(text, "    int i = min(int(t), " + number(table.angles - 2) + ");");
    line(text, "    t -= float(i);");
    if (table.turns < 2) {
        line(text, "    return mix(" + name + "At(i), " + name + "At(i + 1), t);");
    } else {
        line(text, "    float u = turnAbout(wo, n) * " + number(table.turns - 1) + ".0;");
        line(text, "    int k = min(int(u), " + number(table.turns - 2) + ");");
        line(text, "    i += k * " + angles + ";");
        line(text, "    float low = mix(" + name + "At(i), " + name + "At(i + 1), t);");
        line(text, "    i += " + angles + ";");
        line(text, "    return mix(low, mix(" + name + "At(i), " + name +
                       "At(i + 1), t), u - float(k));");
    }
    line(text, "}");
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
