// Every pattern node that has GLSL, as the driver runs it, against its C++ function.

#include "hdDelegate/raster/glProgram.h"
#include "hdDelegate/raster/glResources.h"
#include "hdDelegate/raster/tests/rasterTest.h"
#include "materialNetwork/glsl/glslPatterns.h"
#include "materialNetwork/nodeTable.h"
#include "materialNetwork/tests/materialTest.h"
#include "materialNetwork/value.h"

#include <set>

using namespace patina;

namespace {

constexpr int trials = 8;

struct Case {
    const NodeDef* def;
    Instruction instruction;
    std::vector<std::vector<glm::vec4>> inputs; ///< per trial
    int outputs = 1;
    std::vector<int> components; ///< per output
};

/// Nodes with a function of numbers alone; those that read textures or the surface are in whole
/// materials.
std::vector<Case> cases(int& known) {
    std::vector<Case> out;
    std::set<std::pair<void*, int>> seen;
    Random random(5);
    known = 0;
    for (const auto& def : NodeTable::get().all()) {
        if (!def->function || def->varying || def->inputs.empty()) continue;
        Case c;
        c.def = def.get();
        c.instruction.function = def->function;
        c.instruction.output = 0;
        c.instruction.firstInput = 0;
        c.instruction.data.size = std::max(1, valueTypeComponents(def->inputs[0].type));
        if (!seen.insert({reinterpret_cast<void*>(def->function), c.instruction.data.size}).second)
            continue;
        ++known;
        const auto name = [](int i) { return std::to_string(i); };
        const auto text = glslPattern(c.instruction, name, name);
        if (text.empty()) continue;
        c.outputs = int(text.size());
        for (const OutputDef& o : def->outputs)
            c.components.push_back(valueTypeComponents(o.type));
        for (int t = 0; t < trials; ++t) {
            std::vector<glm::vec4> values;
            for (const InputDef& input : def->inputs) {
                glm::vec4 v(0.0f);
                const int n = valueTypeComponents(input.type);
                for (int k = 0; k < 4; ++k)
                    v[k] = k < n ? 0.1f + 0.8f * random.next() : 0.0f;
                if (input.type == ValueType::Int) v = glm::vec4(std::floor(3.0f * random.next()));
                if (input.type == ValueType::Bool)
                    v = glm::vec4(random.next() > 0.5f ? 1.0f : 0.0f);
                if (n == 1) v = glm::vec4(v.x); // a scalar fills its register
                values.push_back(v);
            }
            c.inputs.push_back(std::move(values));
        }
        out.push_back(std::move(c));
    }
    return out;
}

std::vector<glm::vec4> reference(const Case& c, int trial) {
    std::vector<glm::vec4> registers(24, glm::vec4(0.0f));
    std::vector<uint16_t> pool;
    for (size_t i = 0; i < c.inputs[size_t(trial)].size(); ++i) {
        registers.push_back(c.inputs[size_t(trial)][i]);
        pool.push_back(uint16_t(24 + i));
    }
    const ShadingPoint point;
    const PatternContext context{&point, nullptr};
    c.def->function({registers.data(), pool.data(), 0, c.instruction.data, context});
    registers.resize(24);
    return registers;
}

} // namespace

TEST(PatternAgreement, OfEveryNodeWithItsFunction) {
    PATINA_NEED_CONTEXT();
    int known = 0;
    const std::vector<Case> all = cases(known);
    std::printf("  %zu of %d pattern functions of numbers have GLSL\n", all.size(), known);
    EXPECT_GT(all.size(), 90u);
    std::vector<glm::vec4> inputs;
    std::string body;
    int slot = 0;
    for (const Case& c : all)
        for (int t = 0; t < trials; ++t) {
            const size_t base = inputs.size();
            inputs.insert(inputs.end(), c.inputs[size_t(t)].begin(), c.inputs[size_t(t)].end());
            if (t > 0) continue;
            const size_t stride = c.inputs[0].size();
            const auto text = glslPattern(
                c.instruction,
                [&](int i) {
                    return "inputs[" + std::to_string(base + size_t(i)) + " + t * " +
                           std::to_string(stride) + "]";
                },
                [](int) { return std::string("none"); });
            for (const std::string& expression : text)
                body += "    answers[" + std::to_string(slot++) + " * TRIALS + t] = " + expression +
                        ";\n";
        }
    std::string error;
    const auto program = GlProgram::make(
        {{GL_COMPUTE_SHADER, "patterns",
          "#include \"shaders/raster/material.glsl\"\n"
          "#define TRIALS " +
              std::to_string(trials) +
              "\nlayout(local_size_x = 1) in;\n"
              "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
              "layout(std430, binding = 6) writeonly buffer Answers { vec4 answers[]; };\n"
              "vec4 primvar(int slot, vec4 fallback) { return fallback; }\n"
              "MaterialEval materialEval(vec3 wi) { return materialEvalNone(); }\n"
              "void main() {\n    int t = int(gl_GlobalInvocationID.x);\n" +
              body + "}\n"}},
        error);
    ASSERT_TRUE(program) << error;
    const GlBuffer inputBuffer(inputs),
        answerBuffer(size_t(slot) * trials * sizeof(glm::vec4), nullptr);
    inputBuffer.bindStorage(0);
    answerBuffer.bindStorage(6);
    program->use();
    gl.DispatchCompute(trials, 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<glm::vec4> answers(size_t(slot) * trials);
    answerBuffer.read(answers.data(), answers.size() * sizeof(glm::vec4));

    slot = 0;
    for (const Case& c : all) {
        for (int t = 0; t < trials; ++t) {
            const std::vector<glm::vec4> expected = reference(c, t);
            for (int o = 0; o < c.outputs && size_t(o) < c.components.size(); ++o)
                for (int k = 0; k < c.components[size_t(o)]; ++k) {
                    const float e = expected[size_t(o)][k];
                    EXPECT_NEAR(answers[size_t(slot + o) * trials + size_t(t)][k], e,
                                2e-4f * std::fabs(e) + 2e-5f)
                        << c.def->id << " trial " << t << " output " << o;
                }
        }
        slot += c.outputs;
    }
}
