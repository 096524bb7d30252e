// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/cpu/materialProgram.h"

#include "materialNetwork/cpu/bsdfBuilder.h"
#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/cpu/mediumBuilder.h"
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/compileCounts.h"
#include "materialNetwork/ir/bindMethods.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

BsdfLobe prebuilt(LobeTemplate& t, const glm::vec4* constants) {
    BsdfLobe lobe;
    lobe.kind = t.kind;
    lobe.diffuse = t.diffuse;
    lobe.frame = t.frame;
    lobe.weight = lobe.albedo = glm::vec3(0.0f);
    lobe.probability = 0.0f;
    if (!t.constant) return lobe;
    setupLobe(t, constants, lobe);
    t.energy.measure(lobe);
    return lobe;
}

} // namespace

ProgramCode::ProgramCode(MaterialIr ir) : MaterialIr(std::move(ir)) {
    for (LobeTemplate& t : lobes)
        prebuilt.push_back(patina::prebuilt(t, constants.data()));
}

MaterialProgram::MaterialProgram(MaterialIr ir, MethodPlan planned)
    : _facts(ir.facts), _planned(std::move(planned)),
      _code(std::make_unique<const ProgramCode>(std::move(ir))) {}
MaterialProgram::~MaterialProgram() = default;

const MaterialIr& MaterialProgram::ir() const {
    return *_code;
}

std::shared_ptr<const MaterialProgram>
MaterialProgram::make(const MaterialIr& ir, const MethodSet& methods, MethodPlan planned) {
    ++compileCounts().programs;
    return std::shared_ptr<const MaterialProgram>(
        new MaterialProgram(bindMethods(ir, methods), std::move(planned)));
}

float MaterialProgram::opacity(const ShadingPoint& point, glm::vec3* transmittance,
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
    if (transmittance) *transmittance = glm::vec3(1.0f);
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
    if (transmittance) *transmittance = color;
    return x;
}

bool MaterialProgram::isOpaqueWith(const std::vector<int>& attributes) const {
    if (_facts.isOpaque) return true;
    if (_code->hasPassThrough || !_code->opacityFromPrimvars) return false;
    for (const Instruction& i : _code->opacityCode)
        if (i.data.slot >= 0 &&
            (size_t(i.data.slot) >= attributes.size() || attributes[size_t(i.data.slot)] >= 0))
            return false;
    // Without primvars every reader gives its fallback.
    return opacity(ShadingPoint()) >= 1.0f;
}

glm::vec3 MaterialProgram::emission(const ShadingPoint& point, const glm::vec3& wo) const {
    if (!_facts.hasEmission) return glm::vec3(0.0f);
    if (_code->emissionCode.empty())
        return linearClosure(_code->edf, _code->constants.data(), wo, point.normal, point.tangent);
    RegisterFile registers(*_code);
    registers.run(*_code, _code->emissionCode, point);
    return linearClosure(_code->edf, registers.data(), wo, point.normal, point.tangent);
}

Medium MaterialProgram::interior(const ShadingPoint& point) const {
    if (!_facts.hasInterior) return Medium();
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
    if (!_facts.hasDisplacement) return glm::vec3(0.0f);
    if (!_facts.jitters) return displacementAt(point);
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
    // Walked layers keep all registers, not constants alone.
    if (_code->surfaceCode.empty() && _code->walkedLayers == 0) {
        BsdfBuilder::build(*_code, point, _code->constants.data(), out);
        return;
    }
    RegisterFile registers(*_code);
    registers.run(*_code, _code->surfaceCode, point);
    BsdfBuilder::build(*_code, point, registers.data(), out);
}

} // namespace patina
