// SPDX-License-Identifier: Apache-2.0
// Simplification changes no value: random pattern graphs give the same number whether their leaves
// are constants, which fold, or primvars of the same value, which do not.
#include "materialNetwork/tests/materialFixture.h"

#include <cmath>

namespace patina {

namespace {

struct Choice {
    const char* id;
    std::vector<const char*> inputs;
};

const std::vector<Choice> floatNodes = {
    {"ND_add_float", {"in1", "in2"}},
    {"ND_subtract_float", {"in1", "in2"}},
    {"ND_multiply_float", {"in1", "in2"}},
    {"ND_divide_float", {"in1", "in2"}},
    {"ND_min_float", {"in1", "in2"}},
    {"ND_max_float", {"in1", "in2"}},
    {"ND_power_float", {"in1", "in2"}},
    {"ND_mix_float", {"fg", "bg", "mix"}},
    {"ND_clamp_float", {"in", "low", "high"}},
    {"ND_ifgreater_float", {"value1", "value2", "in1", "in2"}},
    {"ND_ifgreatereq_float", {"value1", "value2", "in1", "in2"}},
    {"ND_ifequal_float", {"value1", "value2", "in1", "in2"}},
    {"ND_switch_float", {"in1", "in2", "in3", "which"}},
    {"ND_invert_float", {"in", "amount"}},
    {"ND_absval_float", {"in"}},
    {"ND_sqrt_float", {"in"}},
    {"ND_smoothstep_float", {"in", "low", "high"}},
    {"ND_modulo_float", {"in1", "in2"}},
    {"ND_dot_float", {"in"}},
};

/// Numbers at which rewriting rules apply are frequent.
float leaf(Random& random) {
    const float special[] = {0.0f, 1.0f, 0.5f, 2.0f, -1.0f};
    const float u = random.next();
    return u < 0.6f ? special[int(u / 0.6f * 5.0f)] : random.next() * 3.0f - 1.0f;
}

/// Two networks of the same shape. `varying` reads its leaves from primvars.
void randomNetworks(uint32_t seed, bool mixed, Network& constant, Network& varying,
                    std::map<std::string, glm::vec4>& primvars) {
    Random random(seed);
    std::vector<NetworkNode> a, b;
    const int leaves = 5, nodes = 12;
    for (int i = 0; i < leaves + nodes; ++i) {
        const std::string name = "n" + std::to_string(i);
        if (i < leaves) {
            const float x = leaf(random);
            a.push_back(makeNode(name, "ND_constant_float", {{"value", number(x)}}));
            if (mixed && random.next() < 0.5f) {
                b.push_back(a.back());
            } else {
                b.push_back(makeNode(name, "ND_geompropvalue_float", {{"geomprop", text(name)}}));
                primvars[name] = glm::vec4(x);
            }
            continue;
        }
        const Choice& choice = floatNodes[size_t(random.next() * float(floatNodes.size()))];
        Connections connections;
        for (const char* input : choice.inputs)
            connections[input] = {"n" + std::to_string(int(random.next() * float(i))), ""};
        a.push_back(makeNode(name, choice.id, {}, connections));
        b.push_back(a.back());
    }
    const std::string last = "n" + std::to_string(leaves + nodes - 1);
    for (auto* list : {&a, &b}) {
        list->push_back(makeNode("color", "ND_convert_float_color3", {}, {{"in", {last, ""}}}));
        list->push_back(makeNode("edf", "ND_uniform_edf", {}, {{"color", {"color", ""}}}));
        list->push_back(makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}}));
    }
    constant = makeNetwork(a);
    varying = makeNetwork(b);
}

float emitted(const Network& network, const std::map<std::string, glm::vec4>& primvars) {
    Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    const FakePrimvars reader(*c.program, primvars);
    ShadingPoint point;
    point.primvars = &reader;
    return c.program->emission(point, glm::vec3(0, 0, 1)).x;
}

} // namespace

TEST(Simplify, FoldedEqualsEvaluated) {
    int different = 0;
    for (uint32_t seed = 1; seed <= 600; ++seed) {
        Network constant, varying;
        std::map<std::string, glm::vec4> primvars;
        randomNetworks(seed, seed % 2 == 0, constant, varying, primvars);
        const float a = emitted(constant, primvars), b = emitted(varying, primvars);
        EXPECT_NEAR(a, b, 1e-5f * (1.0f + std::abs(b))) << "seed " << seed;
        different += a > 0.0f;
    }
    // The test would show nothing if all results were black.
    EXPECT_GT(different, 100);
}

TEST(Simplify, EqualNodesAreMerged) {
    Diagnostics diagnostics;
    std::vector<std::string> cuts;
    const Network network =
        bsdfNetwork({makeNode("a", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.5f)}}),
                     makeNode("b", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.5f)}}),
                     makeNode("bsdf", "ND_mix_bsdf", {{"mix", number(0.5f)}},
                              {{"fg", {"a", ""}}, {"bg", {"b", ""}}})});
    const Graph graph = simplify(buildGraph(network, diagnostics), cuts);
    // The mix of equals is the lobe itself: normal, lobe, surface remain.
    EXPECT_EQ(graph.nodes.size(), 3u) << dumpGraph(graph);
}

TEST(Simplify, DeadBranchesAreCut) {
    Diagnostics diagnostics;
    std::vector<std::string> cuts;
    const Network network = bsdfNetwork(
        {makeNode("file", "ND_image_color3", {{"file", Value::makeFilename("unused.png")}}),
         makeNode("a", "ND_oren_nayar_diffuse_bsdf", {{"weight", number(0.0f)}},
                  {{"color", {"file", ""}}}),
         makeNode("b", "ND_conductor_bsdf"),
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"b", ""}}, {"base", {"a", ""}}})});
    const Graph graph = simplify(buildGraph(network, diagnostics), cuts);
    EXPECT_EQ(dumpGraph(graph).find("unused.png"), std::string::npos);
    EXPECT_EQ(cuts.size(), 2u);
}

} // namespace patina
