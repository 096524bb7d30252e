// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslClosures.h"

#include <cmath>

namespace patina {

namespace {

void line(std::string& text, const std::string& more) {
    text += more + "\n";
}

class EmissionText : public ClosureText {
public:
    using Profile = std::function<std::string(const ClosureOp&)>;
    EmissionText(const GlslRegister& registers, const std::string& prefix, const Profile& profile)
        : ClosureText(registers, prefix), _profile(profile) {}

    static std::string wo() { return "wo"; }
    static std::string normal() { return "point.normal"; }
    bool hasProfile(const ClosureOp& op) const { return !_profile(op).empty(); }
    std::string profile(const ClosureOp& op, const std::string& axis) const {
        return _profile(op) + "(wo, " + axis + ")";
    }

private:
    const Profile& _profile;
};

class MediumText : public ClosureText {
public:
    using ClosureText::ClosureText;

    void addAbsorption(const std::string& weight, const std::string& absorption) {
        line("addAbsorption(m, " + weight + ", " + absorption + ");");
    }
    void addAnisotropic(const std::string& weight, const std::string& absorption,
                        const std::string& scattering, const std::string& anisotropy) {
        line("addAnisotropic(m, " + weight + ", " + absorption + ", " + scattering + ", " +
             anisotropy + ");");
    }
};

} // namespace

std::string glslEmission(const std::vector<ClosureOp>& ops, const std::string& prefix,
                         const GlslRegister& registers,
                         const std::function<std::string(const ClosureOp&)>& profile,
                         std::string& result) {
    EmissionText text(registers, prefix, profile);
    result = emissionOf(ops, text);
    return text.text();
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
    const std::string angles = std::to_string(table.angles),
                      steps = std::to_string(table.angles - 1) + ".0";
    std::string text;
    line(text, "float " + name + "At(int i) {");
    line(text, "    return materialParameter(" + std::to_string(int(first)) + " + i / 4)[i % 4];");
    line(text, "}");
    line(text, "float " + name + "(vec3 wo, vec3 n) {");
    line(text, "    float t = acos(min(abs(dot(wo, n)), 1.0)) * 0.636619772 * " + steps + ";");
    line(text, "    int i = min(int(t), " + std::to_string(table.angles - 2) + ");");
    line(text, "    t -= float(i);");
    if (table.turns < 2) {
        line(text, "    return mix(" + name + "At(i), " + name + "At(i + 1), t);");
    } else {
        line(text, "    float u = turnAbout(wo, n) * " + std::to_string(table.turns - 1) + ".0;");
        line(text, "    int k = min(int(u), " + std::to_string(table.turns - 2) + ");");
        line(text, "    i += k * " + angles + ";");
        line(text, "    float low = mix(" + name + "At(i), " + name + "At(i + 1), t);");
        line(text, "    i += " + angles + ";");
        line(text, "    return mix(low, mix(" + name + "At(i), " + name +
                       "At(i + 1), t), u - float(k));");
    }
    line(text, "}");
    return text;
}

std::string glslMedia(const std::vector<ClosureOp>& ops, const GlslRegister& registers) {
    MediumText text(registers, "v");
    addMedia(ops, text);
    return text.text();
}

} // namespace patina
