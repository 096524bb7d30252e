// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslScattering.h"

#include "materialNetwork/glsl/glslLobes.h"

#include "shaders/shaders.h"

namespace patina {

namespace {

/// A lobe for lights that go through lobes one by one, as GLSL.
struct Trait {
    std::string kind = "LOBE_OTHER", alpha = "0.0", round = "true";
};

Trait traitOf(LobeKind kind, const std::string& lobe) {
    Trait t;
    t.kind = lobeRow(kind).lit;
    if (!lobeHas(kind, lobe::Microfacet)) return t;
    t.kind = (lobeHas(kind, lobe::Interface) ? lobe + ".mode == SCATTER_R && " : "") + lobe +
             ".retro > 0.0 ? LOBE_MIRROR : LOBE_OTHER";
    t.alpha = "sqrt(" + lobe + ".alpha.x * " + lobe + ".alpha.y)";
    t.round = lobe + ".alpha.x == " + lobe + ".alpha.y && " + lobe + ".ndf == NDF_GGX";
    return t;
}

/// A number that may be the same for all lobes.
struct Common {
    int value = 0, count = 0;
    bool same = true;

    void add(int x) {
        same = same && (count == 0 || x == value);
        value = x;
        ++count;
    }
    std::string definition(const std::string& name) const {
        return same && count > 0 ? "#define " + name + " " + std::to_string(value) + "\n" : "";
    }
};

} // namespace

std::string glslFrameOf(const MaterialIr& code, size_t lobe) {
    return "frames[" + std::to_string(code.lobes[lobe].frame) + "]";
}

std::string glslEval(const MaterialIr& code) {
    std::string text = "MaterialEval materialEvalBut(vec3 wi, int without) {\n"
                       "    MaterialEval sum = materialEvalNone();\n"
                       "    bool reflects = isReflected(wi, point.geometricNormal, woOutside());\n";
    for (size_t i = 0; i < code.frames.size(); ++i)
        text += "    vec3 wi" + std::to_string(int(i)) + " = toLocal(frames[" +
                std::to_string(int(i)) + "], wi);\n";
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const LobeTemplate& t = code.lobes[i];
        const std::string n = std::to_string(int(i)), wo = glslFrameOf(code, i) + ".wo",
                          wi = "wi" + std::to_string(t.frame), weight = "lobeWeight[" + n + "]";
        text += "    if (without != " + n + ") addLobe(sum, lobeAgrees(" + wo + ".z, " + wi +
                ".z, reflects) && hasWeight(" + weight + "), " +
                (t.diffuse ? "true, " : "false, ") + weight + ", lobeChance[" + n + "], " +
                lobeRow(t.kind).prefix + "Eval(lobe" + n + ", " + wo + ", " + wi + "));\n";
    }
    return text + "    return sum;\n}\n"
                  "MaterialEval materialEval(vec3 wi) { return materialEvalBut(wi, -1); }\n";
}

std::string glslSample(const MaterialIr& code) {
    std::string text = "MaterialSample materialSample(vec3 u, float uLobe) {\n"
                       "    Selection drawn = selectionNone();\n";
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const std::string n = std::to_string(int(i));
        text += "    selectLobe(drawn, " + n + ", lobeChance[" + n + "], uLobe);\n";
    }
    text += "    MaterialSample s = materialSampleNone();\n"
            "    LobeSample l = lobeSampleNone();\n"
            "    vec3 weight = vec3(0.0);\n"
            "    float chance = 0.0;\n";
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const LobeTemplate& t = code.lobes[i];
        const std::string n = std::to_string(int(i)), frame = glslFrameOf(code, i);
        text += "    if (drawn.lobe == " + n + ") {\n";
        text += "        l = " + std::string(lobeRow(t.kind).prefix) + "Sample(lobe" + n + ", " +
                frame + ".wo, u);\n";
        text += "        s.wi = toWorld(" + frame + ", l.wi);\n";
        text += "        s.diffuse = " + std::string(t.diffuse ? "true" : "false") + ";\n";
        text += "        weight = lobeWeight[" + n + "];\n";
        text += "        chance = lobeChance[" + n + "];\n    }\n";
    }
    return text + "    return finishSample(s, l, drawn.lobe, weight, chance);\n}\n";
}

std::string glslAlbedo(const MaterialIr& code) {
    std::string text = "vec3 materialAlbedo() {\n    vec3 sum = vec3(0.0);\n";
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const std::string n = std::to_string(int(i));
        text += "    if (hasWeight(lobeWeight[" + n + "])) sum += lobeWeight[" + n + "] * " +
                lobeRow(code.lobes[i].kind).prefix + "Albedo(lobe" + n + ", " +
                glslFrameOf(code, i) + ".wo);\n";
    }
    return text + "    return sum;\n}\n";
}

bool glslRefracts(const LobeTemplate& t) {
    return lobeHas(t.kind, lobe::Interface) && !t.passThrough && (t.mode & sh::SCATTER_T) != 0;
}

std::string glslPasses(const MaterialIr& code) {
    std::string sum;
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const std::string n = std::to_string(int(i));
        if (glslRefracts(code.lobes[i]))
            sum += (sum.empty() ? "" : " + ") +
                   ("lobeWeight[" + n + "] * lobeTransmittance[" + n + "]");
    }
    return sum.empty() ? sum : "vec3 materialPasses() { return " + sum + "; }\n";
}

std::string glslTraits(const MaterialIr& code) {
    std::string kinds = "int lobeKind(int i) {\n", alphas = "float lobeAlpha(int i) {\n",
                places = "Frame lobeFrame(int i) {\n", rounds = "bool lobeIsRound(int i) {\n";
    for (size_t i = 0; i < code.lobes.size(); ++i) {
        const std::string at = "    if (i == " + std::to_string(int(i)) + ") return ";
        const Trait t = traitOf(code.lobes[i].kind, "lobe" + std::to_string(int(i)));
        kinds += at + t.kind + ";\n";
        alphas += at + t.alpha + ";\n";
        rounds += at + t.round + ";\n";
        places += at + glslFrameOf(code, i) + ";\n";
    }
    return "const int LOBE_DIFFUSE = 0, LOBE_SHEEN = 1, LOBE_OTHER = 3;\n"
           "const int LOBE_MIRROR = 2; // reflects, by facets\n"
           "const int LOBES = " +
           std::to_string(int(code.lobes.size())) + ";\n" + kinds + "    return LOBE_OTHER;\n}\n" +
           alphas + "    return 0.0;\n}\n" + rounds + "    return true;\n}\n" + places +
           "    return frames[0];\n}\n";
}

std::string glslDefinitions(const MaterialIr& code) {
    Common compensate, albedo, film;
    for (const LobeTemplate& t : code.lobes) {
        if (lobeHas(t.kind, lobe::Microfacet)) {
            compensate.add(t.compensate);
            albedo.add(t.methods.at(Choice::DirectionalAlbedo));
        }
        if (t.film || t.filmDielectric) film.add(t.methods.at(Choice::ThinFilm));
    }
    return compensate.definition("PATINA_COMPENSATE(compensate)") +
           albedo.definition("PATINA_ALBEDO_METHOD(method)") +
           (film.count == 0 ? "#define PATINA_FILM(present) false\n"
                            : film.definition("PATINA_FILM_METHOD(method)"));
}

std::vector<Message> glslWalksLeftOut(const MaterialIr& code) {
    std::vector<Message> found;
    for (const LobeTemplate& t : code.lobes)
        if (t.walks && lobeHas(t.kind, lobe::Microfacet)) {
            found.push_back(messages::compensationReplaced);
            break;
        }
    if (code.walkedLayers > 0) found.push_back(messages::layeringReplaced);
    return found;
}

} // namespace patina
