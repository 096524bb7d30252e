// Every pattern node that has GLSL, as the driver runs it, against its C++ function.

#include "hdDelegate/raster/glProgram.h"
#include "hdDelegate/raster/glResources.h"
#include "hdDelegate/raster/tests/rasterTest.h"
#include "materialNetwork/glsl/glslPatterns.h"
#include "materialNetwork/nodeTable.h"
#include "materialNetwork/tests/materialTest.h"
#include "materialNetwork/value.h"

#include <algorithm>
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
    std::set<void*> seen;
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
        if (!seen.insert(reinterpret_cast<void*>(def->function)).second) continue;
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

class PatternAgreement : public ::testing::TestWithParam<size_t> {};

constexpr size_t chunk = 24; ///< nodes per shader: drivers take long over large ones
constexpr size_t chunks = 7;

TEST_P(PatternAgreement, OfNodesWithTheirFunctions) {
    PATINA_NEED_CONTEXT();
    int known = 0;
    const std::vector<Case> every = cases(known);
    if (GetParam() == 0)
        std::printf("  %zu of %d pattern functions of numbers have GLSL\n", every.size(), known);
    ASSERT_LE(every.size(), chunk * chunks) << "more chunks are needed";
    EXPECT_GT(every.size(), 90u);
    const size_t first = std::min(GetParam() * chunk, every.size());
    const std::vector<Case> all(every.begin() + long(first),
                                every.begin() + long(std::min(first + chunk, every.size())));
    if (all.empty()) return;
    std::vector<glm::vec4> inputs;
    std::string body;
    int slot = 0;
    for (const Case& c : all) {
        const size_t base = inputs.size(), stride = c.inputs[0].size();
        for (const auto& values : c.inputs)
            inputs.insert(inputs.end(), values.begin(), values.end());
        const auto text = glslPattern(
            c.instruction,
            [&](int i) {
                return "inputs[" + std::to_string(base + size_t(i)) + " + t * " +
                       std::to_string(stride) + "]";
            },
            [](int) { return std::string("none"); });
        for (const std::string& expression : text)
            body +=
                "    answers[" + std::to_string(slot++) + " * TRIALS + t] = " + expression + ";\n";
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

INSTANTIATE_TEST_SUITE_P(EveryNode, PatternAgreement, ::testing::Range(size_t(0), chunks));
