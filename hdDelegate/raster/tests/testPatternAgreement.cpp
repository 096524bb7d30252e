// SPDX-License-Identifier: Apache-2.0
// Every pattern node, as the driver runs its GLSL, against its C++ function.

#include "hdDelegate/raster/tests/rasterFixture.h"
#include "materialNetwork/glsl/glslPatterns.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/network/value.h"

#include <algorithm>
#include <set>

using namespace patina;

namespace {

constexpr int trials = 8;

struct Case {
    const NodeDef* def;
    Instruction instruction;
    std::vector<int> firstRow;                  ///< of each input but texts among `inputs`
    std::vector<std::vector<glm::vec4>> inputs; ///< rows of all inputs, per trial
    std::vector<int> components;                ///< per output row
};

int rowsOf(ValueType type) {
    return type == ValueType::Matrix33 ? 3 : type == ValueType::Matrix44 ? 4 : 1;
}

void addRows(const InputDef& input, Random& random, std::vector<glm::vec4>& values) {
    const int rows = rowsOf(input.type);
    const int n = rows > 1 ? rows : valueTypeComponents(input.type);
    for (int row = 0; row < rows; ++row) {
        glm::vec4 v(0.0f);
        for (int k = 0; k < 4; ++k)
            v[k] = k < n ? 0.1f + 0.8f * random.next() : 0.0f;
        if (rows > 1) v[row] += 2.0f; // well conditioned
        if (input.type == ValueType::Int) v = glm::vec4(std::floor(3.0f * random.next()));
        if (input.type == ValueType::Bool) v = glm::vec4(random.next() > 0.5f ? 1.0f : 0.0f);
        if (input.name == "tap") v = glm::floor(25.0f * v);
        if (n == 1) v = glm::vec4(v.x); // a scalar fills its register
        values.push_back(v);
    }
}

bool hasSpaces(const NodeDef& def) {
    for (const InputDef& input : def.inputs)
        if (input.name == "space" || input.name == "fromspace") return true;
    return false;
}

/// Every node with a pattern, once for all that share its function, and once for each space.
std::vector<Case> cases() {
    std::vector<Case> out;
    std::set<std::string> seen;
    Random random(5);
    for (const auto& def : NodeTable::get().all()) {
        if (!def->pattern || def->outputs.empty() || isTextType(def->outputs[0].type)) continue;
        if (!seen.insert(def->pattern->name).second) continue;
        for (int mode = 0; mode < (hasSpaces(*def) ? 3 : 1); ++mode) {
            Case c;
            c.def = def.get();
            c.instruction.pattern = def->pattern;
            c.instruction.output = 0;
            c.instruction.firstInput = 0;
            c.instruction.data.mode = mode;
            for (int& handle : c.instruction.data.textures)
                handle = 0;
            c.instruction.data.slot = 0;
            if (!def->inputs.empty())
                c.instruction.data.size = std::max(1, valueTypeComponents(def->inputs[0].type));
            for (const OutputDef& o : def->outputs)
                for (int row = 0; row < rowsOf(o.type); ++row)
                    c.components.push_back(rowsOf(o.type) > 1 ? rowsOf(o.type)
                                                              : valueTypeComponents(o.type));
            int rows = 0;
            for (const InputDef& input : def->inputs) {
                if (isTextType(input.type)) continue;
                c.firstRow.push_back(rows);
                rows += rowsOf(input.type);
            }
            for (int t = 0; t < trials; ++t) {
                std::vector<glm::vec4> values;
                for (const InputDef& input : def->inputs)
                    if (!isTextType(input.type)) addRows(input, random, values);
                if (values.empty()) values.emplace_back(0.0f);
                c.inputs.push_back(std::move(values));
            }
            out.push_back(std::move(c));
        }
    }
    return out;
}

/// The same primvar for every slot.
class OnePrimvar : public PrimvarReader {
public:
    bool read(int, float out[4]) const override {
        const float v[4] = {0.4f, 0.6f, 0.1f, 0.2f};
        std::copy(v, v + 4, out);
        return true;
    }
};

ShadingPoint somewhere(const PrimvarReader& primvars) {
    ShadingPoint p;
    p.position = {0.3f, -0.2f, 0.5f};
    p.objectPosition = {0.1f, 0.7f, -0.4f};
    p.normal = p.geometricNormal = {0.0f, 0.6f, 0.8f};
    p.tangent = {1, 0, 0};
    p.bitangent = {0.0f, 0.8f, -0.6f};
    p.viewDirection = {0.6f, 0.0f, 0.8f};
    p.objectToWorldNormal = glm::mat3(1.5f, 0.2f, 0.0f, -0.1f, 0.7f, 0.3f, 0.0f, 0.1f, 1.2f);
    p.lengthPerUv = 2.0f;
    p.uvFootprint = 0.01f;
    p.seed = 77;
    p.primvars = &primvars;
    return p;
}

const char* const somewhereInGlsl = R"(
vec4 materialParameter(int i) { return vec4(0.0); }
MaterialEval materialEvalBut(vec3 wi, int without) { return materialEvalNone(); }
vec4 primvar(int slot, vec4 fallback) { return vec4(0.4, 0.6, 0.1, 0.2); }
vec4 texel(int map, vec2 uv, float footprint) { return vec4(uv, 0.5, 1.0); } // as FakeTextures
void somewhere() {
    point.position = vec3(0.3, -0.2, 0.5);
    point.objectPosition = vec3(0.1, 0.7, -0.4);
    point.normal = point.geometricNormal = vec3(0.0, 0.6, 0.8);
    point.tangent = vec3(1.0, 0.0, 0.0);
    point.bitangent = vec3(0.0, 0.8, -0.6);
    point.view = vec3(0.6, 0.0, 0.8);
    point.objectToWorldNormal = mat3(1.5, 0.2, 0.0, -0.1, 0.7, 0.3, 0.0, 0.1, 1.2);
    point.lengthPerUv = 2.0;
    point.uvFootprint = 0.01;
    point.seed = 77u;
}
)";

std::vector<glm::vec4> reference(const Case& c, int trial) {
    std::vector<glm::vec4> registers(24, glm::vec4(0.0f));
    std::vector<uint16_t> pool;
    for (const int row : c.firstRow)
        pool.push_back(uint16_t(24 + row));
    const auto& rows = c.inputs[size_t(trial)];
    registers.insert(registers.end(), rows.begin(), rows.end());
    FakeTextures textures;
    textures.open({});
    const OnePrimvar primvars;
    const ShadingPoint point = somewhere(primvars);
    const PatternContext context{&point, &textures};
    c.def->pattern->function({registers.data(), pool.data(), 0, c.instruction.data, context});
    registers.resize(24);
    return registers;
}

} // namespace

class PatternAgreement : public ::testing::TestWithParam<size_t> {};

constexpr size_t chunk = 8; ///< nodes per shader: drivers take long over large ones
constexpr size_t chunks = 32;

TEST_P(PatternAgreement, OfNodesWithTheirFunctions) {
    PATINA_NEED_CONTEXT();
    const std::vector<Case> every = cases();
    ASSERT_LE(every.size(), chunk * chunks) << "more chunks are needed";
    EXPECT_GT(every.size(), 180u);
    const size_t first = std::min(GetParam() * chunk, every.size());
    const std::vector<Case> all(every.begin() + long(first),
                                every.begin() + long(std::min(first + chunk, every.size())));
    if (all.empty()) return;
    std::vector<glm::vec4> inputs;
    std::string body;
    std::set<std::string> files;
    int slot = 0;
    for (const Case& c : all) {
        const size_t base = inputs.size(), stride = c.inputs[0].size();
        for (const auto& values : c.inputs)
            inputs.insert(inputs.end(), values.begin(), values.end());
        if (c.def->pattern->file) files.insert(c.def->pattern->file);
        body += "    " +
                glslPattern(c.instruction,
                            {[&](int i, int row) {
                                 return "inputs[" +
                                        std::to_string(base + size_t(c.firstRow[size_t(i)] + row)) +
                                        " + t * " + std::to_string(stride) + "]";
                             },
                             [&](int row) {
                                 return "answers[" + std::to_string(slot + row) + " * TRIALS + t]";
                             },
                             [](int) { return 0; }}) +
                "\n";
        slot += c.def->pattern->outputRows();
    }
    std::string includes = "#include \"shaders/raster/material.glsl\"\n";
    for (const std::string& file : files)
        includes += "#include \"" + file + "\"\n";
    const auto program = computeProgram(
        "patterns",
        includes + "#define TRIALS " + std::to_string(trials) +
            "\nlayout(local_size_x = 1) in;\n"
            "layout(std430, binding = 0) readonly buffer Inputs { vec4 inputs[]; };\n"
            "layout(std430, binding = 6) writeonly buffer Answers { vec4 answers[]; };\n" +
            somewhereInGlsl +
            "void main() {\n    somewhere();\n    int t = int(gl_GlobalInvocationID.x);\n" + body +
            "}\n");
    ASSERT_TRUE(program);
    const GlBuffer inputBuffer(inputs),
        answerBuffer(size_t(slot) * trials * sizeof(glm::vec4), nullptr);
    inputBuffer.bindStorage(0);
    answerBuffer.bindStorage(6);
    const auto answers = computed<glm::vec4>(*program, trials, answerBuffer, size_t(slot) * trials);

    slot = 0;
    for (const Case& c : all) {
        // The random numbers of hexagons are fractions of a product below 2^15: one rounding more
        // or less, as of a fused sum, moves them by 2^-9, and what they turn by as much.
        const float random = c.def->id.find("hextiled") != std::string::npos ? 0x1p-9f : 0.0f;
        for (int t = 0; t < trials; ++t) {
            const std::vector<glm::vec4> expected = reference(c, t);
            for (int o = 0; o < int(c.components.size()); ++o)
                for (int k = 0; k < c.components[size_t(o)]; ++k) {
                    const float e = expected[size_t(o)][k];
                    EXPECT_NEAR(answers[size_t(slot + o) * trials + size_t(t)][k], e,
                                2e-4f * std::fabs(e) + 2e-5f + random)
                        << c.def->id << " trial " << t << " output " << o;
                }
        }
        slot += c.def->pattern->outputRows();
    }
}

INSTANTIATE_TEST_SUITE_P(EveryNode, PatternAgreement, ::testing::Range(size_t(0), chunks));
