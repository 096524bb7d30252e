// SPDX-License-Identifier: Apache-2.0
// Simplification changes no value: random pattern graphs give the same number whether their leaves
// are constants, which fold, or primvars of the same value, which do not.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

namespace {

/// Inputs, and the nodes that have them.
const std::vector<std::pair<std::vector<const char*>, std::vector<const char*>>> floatNodes = {
    {{"in1", "in2"}, {"add", "subtract", "multiply", "divide", "min", "max", "power", "modulo"}},
    {{"fg", "bg", "mix"}, {"mix"}},
    {{"in", "low", "high"}, {"clamp", "smoothstep"}},
    {{"value1", "value2", "in1", "in2"}, {"ifgreater", "ifgreatereq", "ifequal"}},
    {{"in1", "in2", "in3", "which"}, {"switch"}},
    {{"in", "amount"}, {"invert"}},
    {{"in"}, {"absval", "sqrt", "dot"}},
};

template <class T> const T& oneOf(Random& random, const std::vector<T>& of) {
    return of[size_t(random.next() * float(of.size()))];
}

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
    for (int i = 0; i < leaves; ++i) {
        const std::string name = numbered("n", i);
        const float x = leaf(random);
        a.push_back(makeNode(name, "ND_constant_float", {{"value", x}}));
        if (mixed && random.next() < 0.5f) {
            b.push_back(a.back());
        } else {
            b.push_back(makeNode(name, "ND_geompropvalue_float", {{"geomprop", name}}));
            primvars[name] = glm::vec4(x);
        }
    }
    for (int i = leaves; i < leaves + nodes; ++i) {
        const auto& [inputs, categories] = oneOf(random, floatNodes);
        const char* category = oneOf(random, categories);
        Connections connections;
        for (const char* input : inputs)
            connections[input] = numbered("n", int(random.next() * float(i)));
        a.push_back(
            makeNode(numbered("n", i), std::string("ND_") + category + "_float", {}, connections));
        b.push_back(a.back());
    }
    const std::string last = numbered("n", leaves + nodes - 1);
    constant = showing(a, last);
    varying = showing(b, last);
}

} // namespace

TEST(Simplify, FoldedEqualsEvaluated) {
    int different = 0;
    for (uint32_t seed = 1; seed <= 600; ++seed) {
        Network constant, varying;
        std::map<std::string, glm::vec4> primvars;
        randomNetworks(seed, seed % 2 == 0, constant, varying, primvars);
        const float a = emitted(constant, {}, primvars).x, b = emitted(varying, {}, primvars).x;
        EXPECT_NEAR(a, b, 1e-5f * (1.0f + std::abs(b))) << "seed " << seed;
        different += a > 0.0f;
    }
    // The test would show nothing if all results were black.
    EXPECT_GT(different, 100);
}

TEST(Simplify, EqualNodesAreMerged) {
    Diagnostics diagnostics;
    std::vector<std::string> cuts;
    const Network network = bsdfNetwork({diffuseNode("a", grey(0.5f)), diffuseNode("b", grey(0.5f)),
                                         mixNode("bsdf", "a", "b", 0.5f)});
    const Graph graph = simplify(buildGraph(network, diagnostics), cuts);
    // The mix of equals is the lobe itself: normal, lobe, surface remain.
    EXPECT_EQ(graph.nodes.size(), 3u) << dumpGraph(graph);
}

TEST(Simplify, DeadBranchesAreCut) {
    Diagnostics diagnostics;
    std::vector<std::string> cuts;
    const Network network = bsdfNetwork(
        {makeNode("file", "ND_image_color3", {{"file", file("unused.png")}}),
         makeNode("a", "ND_oren_nayar_diffuse_bsdf", {{"weight", 0.0f}}, {{"color", "file"}}),
         makeNode("b", "ND_conductor_bsdf"), layerNode("bsdf", "b", "a")});
    const Graph graph = simplify(buildGraph(network, diagnostics), cuts);
    EXPECT_FALSE(has(dumpGraph(graph), "unused.png"));
    EXPECT_EQ(cuts.size(), 2u);
}
