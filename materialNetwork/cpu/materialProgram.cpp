#include "materialNetwork/cpu/materialProgram.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/mediumBuilder.h"
#include "materialNetwork/cpu/programBuilder.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace patina {

RegisterFile::RegisterFile(const ProgramCode& code) : _data(_local) {
    if (code.registerCount > localCount) {
        static thread_local std::vector<glm::vec4> large;
        if (int(large.size()) < code.registerCount) large.resize(size_t(code.registerCount));
        _data = large.data();
    }
    std::memcpy(static_cast<void*>(_data), code.constants.data(),
                code.constants.size() * sizeof(glm::vec4));
}

void RegisterFile::run(const ProgramCode& code, const std::vector<Instruction>& instructions,
                       const ShadingPoint& point) {
    const PatternContext context{&point, code.textures};
    for (const Instruction& i : instructions)
        i.function({_data, code.inputPool.data() + i.firstInput, i.output, i.data, context});
}

MaterialProgram::MaterialProgram() = default;
MaterialProgram::~MaterialProgram() = default;

std::shared_ptr<const MaterialProgram>
MaterialProgram::compile(const Plan& plan, TextureSource& textures, Diagnostics& diagnostics) {
    return ProgramBuilder(plan, textures, diagnostics).build();
}

float MaterialProgram::opacity(const ShadingPoint& point, glm::vec3* passes,
                               float* presence) const {
    float x;
    if (_code->opacityCode.empty()) {
        x = _code->constants[_code->opacity].x;
    } else {
        RegisterFile registers(*_code);
        registers.run(*_code, _code->opacityCode, point);
        x = registers.data()[_code->opacity].x;
    }
    x = sh::unit(x);
    if (passes) *passes = glm::vec3(1.0f);
    if (presence) *presence = x;
    if (!_code->hasPassThrough || x == 0.0f) return x;
    glm::vec3 passThrough;
    if (_code->surfaceCode.empty()) {
        passThrough = BsdfBuilder::passThrough(*_code, point, _code->constants.data());
    } else {
        RegisterFile registers(*_code);
        registers.run(*_code, _code->surfaceCode, point);
        passThrough = BsdfBuilder::passThrough(*_code, point, registers.data());
    }
    glm::vec3 color;
    x = sh::presenceOf(x, passThrough, color);
    if (passes) *passes = color;
    return x;
}

bool MaterialProgram::isOpaqueWith(const std::vector<int>& attributes) const {
    if (_isOpaque) return true;
    if (_code->hasPassThrough || !_code->opacityFromPrimvars) return false;
    for (const Instruction& i : _code->opacityCode)
        if (i.data.slot >= 0 &&
            (size_t(i.data.slot) >= attributes.size() || attributes[size_t(i.data.slot)] >= 0))
            return false;
    // Without primvars every reader gives its fallback.
    return opacity(ShadingPoint()) >= 1.0f;
}

glm::vec3 MaterialProgram::emission(const ShadingPoint& point, const glm::vec3& wo) const {
    if (!_hasEmission) return glm::vec3(0.0f);
    if (_code->emissionCode.empty())
        return linearClosure(_code->edf, _code->constants.data(), wo, point.normal, point.tangent);
    RegisterFile registers(*_code);
    registers.run(*_code, _code->emissionCode, point);
    return linearClosure(_code->edf, registers.data(), wo, point.normal, point.tangent);
}

Medium MaterialProgram::interior(const ShadingPoint& point) const {
    if (!_hasInterior) return Medium();
    const auto build = [&](const glm::vec4* registers) {
        Medium medium = buildMedium(_code->vdf, registers);
        medium.emission = linearClosure(_code->volumeEdf, registers, glm::vec3(0.0f),
                                        glm::vec3(0.0f), glm::vec3(0.0f));
        return medium;
    };
    if (_code->interiorCode.empty()) return build(_code->constants.data());
    RegisterFile registers(*_code);
    registers.run(*_code, _code->interiorCode, point);
    return build(registers.data());
}

glm::vec3 MaterialProgram::displacement(const ShadingPoint& point) const {
    if (!_hasDisplacement) return glm::vec3(0.0f);
    if (!_jitters) return displacementAt(point);
    // Vertices are moved once for all samples.
    glm::vec3 sum(0.0f);
    ShadingPoint jittered = point;
    for (jittered.seed = 1; jittered.seed <= steadySeeds; ++jittered.seed)
        sum += displacementAt(jittered);
    return sum / float(steadySeeds);
}

glm::vec3 MaterialProgram::displacementAt(const ShadingPoint& point) const {
    RegisterFile registers(*_code);
    registers.run(*_code, _code->displacementCode, point);
    const glm::vec4& value = registers.data()[_code->displacement];
    const float scale = registers.data()[_code->displacementScale].x;
    const glm::vec3 moved =
        (_code->displacementIsVector ? glm::vec3(value) : glm::vec3(0.0f, 0.0f, value.x)) * scale;
    return std::isfinite(moved.x + moved.y + moved.z) ? moved : glm::vec3(0.0f);
}

void MaterialProgram::evaluate(const ShadingPoint& point, Bsdf& out) const {
    if (_code->surfaceCode.empty()) {
        BsdfBuilder::build(*_code, point, _code->constants.data(), out);
        return;
    }
    RegisterFile registers(*_code);
    registers.run(*_code, _code->surfaceCode, point);
    BsdfBuilder::build(*_code, point, registers.data(), out);
}

} // namespace patina
