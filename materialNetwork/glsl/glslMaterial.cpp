// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/glsl/glslMaterial.h"

#include "materialNetwork/ir/lobeFacts.h"
#include "materialNetwork/glsl/glslClosures.h"
#include "materialNetwork/glsl/glslLayers.h"
#include "materialNetwork/glsl/glslLobes.h"
#include "materialNetwork/glsl/glslPatterns.h"
#include "materialNetwork/glsl/glslScattering.h"

#include <algorithm>
#include <functional>
#include <set>

namespace patina {

namespace {

/// OpenGL promises uniform blocks of 1024 vectors, and all drivers have room for four times that.
constexpr size_t maxWithCurves = 2048;

/// Writes the text of one material. Every use of a constant gets a parameter of its own, so that
/// equal constants do not change the text.
class Writer {
public:
    Writer(const MaterialIr& ir, const GlslFeatures& features, GlslMaterial& out)
        : _features(features), _code(ir), _facts(ir.facts), _out(out) {}

    void write() {
        for (const auto* list :
             {&_code.surfaceCode, &_code.emissionCode, &_code.opacityCode, &_code.interiorCode})
            declareRegisters(*list);
        for (size_t i = 0; i < _code.lobes.size(); ++i)
            line(glslLobeType(_code.lobes[i].kind) + " lobe" + std::to_string(int(i)) + ";");
        const int lobes = std::max(1, int(_code.lobes.size()));
        line("vec3 lobeWeight[" + std::to_string(lobes) + "];");
        line("vec3 lobeAlbedo[" + std::to_string(lobes) + "];");
        line("float lobeChance[" + std::to_string(lobes) + "];");
        if (std::any_of(_code.lobes.begin(), _code.lobes.end(), glslRefracts))
            line("vec3 lobeTransmittance[" + std::to_string(lobes) + "];");
        line("Frame frames[" + std::to_string(std::max(1, int(_code.frames.size()))) + "];");
        line("vec3 passThrough;");
        _out.leftOut = glslWalksLeftOut(_code);
        if (asksForDispersion()) _out.leftOut.push_back(messages::dispersionLeftOut);
        instantiateFunction();
        setupFunction();
        presenceFunction();
        emissionFunction();
        if (_facts.hasInterior) mediumFunction();
        _text += glslEval(_code) + glslSample(_code);
        const std::string textures =
            glslTextureText(_textures, _code.textures, _features.textureArrays, _out.textures,
                            _out.parameters, _out.leftOut);
        std::string head;
        for (const std::string& file : _files)
            head += "#include \"" + file + "\"\n";
        head += "layout(std140, binding = 1) uniform Parameters { vec4 parameters[" +
                std::to_string(std::max(1, int(_out.parameters.size()))) +
                "]; };\nvec4 materialParameter(int i) { return parameters[i]; }\n" + textures;
        _out.text = head + _text;
        _out.albedoText = glslAlbedo(_code);
        _out.passesText = glslPasses(_code);
        _out.traitsText = glslTraits(_code);
        _out.definitions = glslDefinitions(_code);
        if (_out.parameters.empty()) _out.parameters.emplace_back(0.0f);
        _out.presence = !_facts.isOpaque;
        _out.emission = _facts.hasEmission;
        _out.hasColoredPresence = _code.hasPassThrough;
        _out.hasInterior = _facts.hasInterior;
        _out.volumeOnly = _facts.isVolumeOnly;
        _out.thin = _facts.isThinWalled;
        _out.fibre = _facts.isFibre;
        _out.transmits = _out.volumeOnly || (_facts.hasTransmission && !_facts.isFibre);
    }

private:
    void line(const std::string& text) { _text += text + "\n"; }

    std::string reg(Register r) {
        if (r >= _code.constants.size()) return "r" + std::to_string(r);
        _out.parameters.push_back(_code.constants[r]);
        return "parameters[" + std::to_string(int(_out.parameters.size()) - 1) + "]";
    }
    std::string reg(int r) { return reg(Register(r)); }

    std::function<std::string(int)> registers() {
        return [this](int r) { return reg(r); };
    }

    int texture(int handle) {
        const auto found = std::find(_textures.begin(), _textures.end(), handle);
        if (found != _textures.end()) return int(found - _textures.begin());
        _textures.push_back(handle);
        return int(_textures.size()) - 1;
    }

    void declareRegisters(const std::vector<Instruction>& code) {
        for (const Instruction& i : code)
            for (int k = 0; k < i.pattern->outputRows(); ++k)
                if (_declared.insert(i.output + k).second)
                    line("vec4 r" + std::to_string(i.output + k) + ";");
    }

    void instructions(const std::vector<Instruction>& code) {
        for (const Instruction& i : code) {
            line("    " +
                 glslPattern(i, {[&](int input, int row) {
                                     return reg(_code.inputPool[i.firstInput + uint32_t(input)] +
                                                row);
                                 },
                                 [&](int row) { return "r" + std::to_string(i.output + row); },
                                 [&](int handle) { return texture(handle); }}));
            if (i.pattern->file) _files.insert(i.pattern->file);
        }
    }

    void frame(int i) {
        const FrameTemplate& f = _code.frames[size_t(i)];
        const std::string n = f.normal >= 0 ? reg(f.normal) + ".xyz" : "vec3(0.0)";
        const std::string t = f.tangent >= 0 ? reg(f.tangent) + ".xyz" : "vec3(0.0)";
        line("    frames[" + std::to_string(i) + "] = makeFrame(" + n + ", " + t + ", " +
             (f.flips ? "true, " : "false, ") + (f.bends ? "true);" : "false);"));
    }

    /// Lobes set up, with weights that do not yet know what passes straight.
    /// Also where nothing lets light through yet, which an input of the page may change.
    bool asksForDispersion() const {
        return std::any_of(_code.surfaceCode.begin(), _code.surfaceCode.end(),
                           [](const Instruction& i) { return i.pattern->spectral(); }) &&
               std::any_of(_code.lobes.begin(), _code.lobes.end(), [](const LobeTemplate& t) {
                   return t.methods.get<method::Dispersion>() != method::Dispersion::None;
               });
    }

    void instantiateFunction() {
        line("void instantiate() {");
        instructions(_code.surfaceCode);
        for (size_t i = 0; i < _code.frames.size(); ++i)
            frame(int(i));
        for (size_t i = 0; i < _code.lobes.size(); ++i)
            instantiateLobe(i);
        _text += glslWeights(_code, registers());
        line("    passThrough = vec3(0.0);");
        for (size_t i = 0; i < _code.lobes.size(); ++i)
            if (_code.lobes[i].passThrough)
                line("    passThrough += lobeWeight[" + std::to_string(int(i)) + "] * slab" +
                     std::to_string(int(i)) + ".transmittance;");
        if (_code.hasPassThrough) {
            line("    passThrough = unitColor(passThrough);");
            line("    float scale = slabScale(passThrough);");
            for (size_t i = 0; i < _code.lobes.size(); ++i)
                line("    lobeWeight[" + std::to_string(int(i)) + "] *= " +
                     (_code.lobes[i].passThrough
                          ? "slab" + std::to_string(int(i)) + ".reflected * scale;"
                          : "scale;"));
        }
        line("}");
    }

    /// Where the parameters hold the curve that the program reads albedos of a constant interface
    /// from. Whether there is one is a parameter too: it hangs on roughness and ior.
    std::string curve(const LobeTemplate& t) {
        const bool schlick = t.kind == LobeKind::Schlick;
        if (!_features.energyCurves || !t.constant) return "-1";
        const size_t first = _out.parameters.size(), width = schlick ? 4 : 1;
        const size_t size = 1 + EnergyCurve::nodeCount * width;
        if (first + size > maxWithCurves) return "-1";
        _out.parameters.resize(first + size, glm::vec4(0.0f));
        glm::vec4* out = &_out.parameters[first];
        *out++ = glm::vec4(t.energy.nodes().empty() ? 0.0f : 1.0f);
        for (const EnergyCurve::Energy& e : t.energy.nodes()) {
            if (schlick) {
                for (const glm::vec3& v : {e.kr, e.kt, e.r, e.t})
                    *out++ = glm::vec4(v, 0.0f);
            } else {
                *out++ = {e.kr.x, e.kt.x, e.r.x, e.t.x};
            }
        }
        return std::to_string(int(first));
    }

    void instantiateLobe(size_t i) {
        const LobeTemplate& t = _code.lobes[i];
        const std::string n = std::to_string(int(i)), lobe = "lobe" + n;
        const auto registers = [&](Register r) { return reg(r); };
        line("    " + lobe + " = " + glslLobeSetup(t, registers) + ";");
        if (t.ndf != 0) line("    " + lobe + ".ndf = " + std::to_string(t.ndf) + ";");
        _text += glslLobeMethods(t, lobe);
        const LobeKind kind = t.kind;
        const bool interface = lobeHas(kind, lobe::Interface);
        const std::string wo = glslFrameOf(_code, i) + ".wo", albedo = "lobeAlbedo[" + n + "]";
        if (!lobeFactsOf(kind).fix)
            line("    " + albedo + " = " + lobeRow(kind).prefix + "Albedo(" + lobe + ", " + wo +
                 ");");
        line("    vec3 coverage" + n + " = " +
             (lobeFactsOf(kind).fix ? "lobeFix(" + lobe + ", " + wo + ", " +
                                          (interface ? curve(t) + ", " : "") + albedo + ");"
                                    : "vec3(1.0);"));
        const bool tinted = _code.layerTransmittance == LayerTransmittance::Tinted &&
                            lobeHas(kind, lobe::Covers) && (!interface || t.mode == sh::SCATTER_R);
        line("    coverage" + n + " = " + glslCoverage(_code, tinted ? albedo : "coverage" + n) +
             ";");
        if (glslRefracts(t)) line("    lobeTransmittance[" + n + "] = fixTransmittance;");
        if (!t.passThrough) return;
        line("    Slab slab" + n + " = " + lobeRow(kind).prefix + "Slab(" + lobe + ", " + wo +
             ", " + albedo + ", " + (_code.slabsHaveTwoFaces ? "true" : "false") + ");");
    }

    /// As BsdfBuilder::setSelectionPdfs().
    void setupFunction() {
        line("void materialSetup() {");
        line("    instantiate();");
        line("    float sum = 0.0;");
        line("    int present = 0;");
        for (size_t i = 0; i < _code.lobes.size(); ++i) {
            const std::string n = "[" + std::to_string(int(i)) + "]";
            line("    bool has" + std::to_string(int(i)) + " = hasWeight(lobeWeight" + n + ");");
            line("    present += has" + std::to_string(int(i)) + " ? 1 : 0;");
        }
        for (size_t i = 0; i < _code.lobes.size(); ++i) {
            const std::string n = "[" + std::to_string(int(i)) + "]";
            line("    lobeChance" + n + " = !has" + std::to_string(int(i)) +
                 " ? 0.0 : selectionShare(lobeWeight" + n + ", lobeAlbedo" + n +
                 ", present == 1);");
            line("    sum += lobeChance" + n + ";");
        }
        for (size_t i = 0; i < _code.lobes.size(); ++i) {
            const std::string n = "[" + std::to_string(int(i)) + "]";
            line("    lobeChance" + n + " /= sum > 0.0 ? sum : 1.0;");
            line("    if (!(sum > 0.0)) lobeWeight" + n + " = vec3(0.0);");
        }
        line("}");
    }

    void presenceFunction() {
        line("float materialPresence(out vec3 passes) {");
        line("    passes = vec3(1.0);");
        instructions(_code.opacityCode);
        const std::string opacity = reg(_code.opacity) + ".x";
        line("    presentShare = unit(" + opacity + ");");
        if (_code.hasPassThrough) line("    instantiate();");
        line(_code.hasPassThrough ? "    return presenceOf(" + opacity + ", passThrough, passes);"
                                  : "    return presentShare;");
        line("}");
    }

    void emissionFunction() {
        // Nodes of one file share its table.
        std::vector<std::pair<const EmissionProfile*, std::string>> profiles;
        const auto profile = [&](const ClosureOp& op) {
            const auto known =
                std::find_if(profiles.begin(), profiles.end(),
                             [&](const auto& item) { return item.first == op.profile.get(); });
            return known != profiles.end() ? known->second : std::string();
        };
        for (const ClosureOp& op : _code.edf) {
            if (!op.profile || !profile(op).empty()) continue;
            const GlslProfileTable table(*op.profile);
            const size_t first = _out.parameters.size();
            if (first + table.values.size() > maxWithCurves) {
                _out.leftOut.push_back(messages::profileWithoutRoom);
                break;
            }
            _out.parameters.insert(_out.parameters.end(), table.values.begin(), table.values.end());
            profiles.emplace_back(op.profile.get(),
                                  "profile" + std::to_string(int(profiles.size())));
            _text += glslProfile(profiles.back().second, table, first);
        }
        line("vec3 materialEmission(vec3 wo) {");
        instructions(_code.emissionCode);
        std::string result;
        _text += glslEmission(_code.edf, "e", registers(), profile, result);
        line("    return " + result + ";");
        line("}");
    }

    void mediumFunction() {
        line("Medium materialMedium() {");
        line("    Medium m = mediumNone();");
        instructions(_code.interiorCode);
        _text += glslMedia(_code.vdf, registers());
        line("    vec3 wo = vec3(0.0);");
        std::string result;
        const auto even = [](const ClosureOp&) { return std::string(); };
        _text += glslEmission(_code.volumeEdf, "g", registers(), even, result);
        line("    m.emission = " + result + ";");
        line("    return m;");
        line("}");
    }

    const GlslFeatures& _features;
    const MaterialIr& _code;
    const MaterialFacts& _facts;
    GlslMaterial& _out;
    std::string _text;
    std::set<int> _declared;
    std::vector<int> _textures;   ///< handles in the order of `texture0`...
    std::set<std::string> _files; ///< of functions that patterns call
};

} // namespace

GlslMaterial makeGlslMaterial(const MaterialIr& ir, const GlslFeatures& features) {
    GlslMaterial out;
    Writer(ir, features, out).write();
    return out;
}

} // namespace patina
