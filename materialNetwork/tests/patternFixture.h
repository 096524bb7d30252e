// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/algebra.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/network/value.h"

namespace patina {

/// Numbers of one output of a pattern node that reads nothing but its inputs.
inline std::vector<float> folded(const std::string& id,
                                 const std::map<std::string, std::vector<float>>& inputs,
                                 size_t output = 0) {
    GraphNode node;
    node.def = NodeTable::get().find(id);
    EXPECT_NE(node.def, nullptr) << id;
    if (!node.def) return {};
    for (const auto& [name, numbers] : inputs)
        EXPECT_GE(node.def->findInput(name), 0) << id << " " << name;
    for (const InputDef& input : node.def->inputs) {
        Operand operand;
        operand.value = input.value;
        const auto given = inputs.find(input.name);
        if (given != inputs.end()) operand.value.numbers = given->second;
        node.inputs.push_back(operand);
    }
    std::vector<Value> outputs;
    EXPECT_TRUE(foldPattern(node, outputs)) << id;
    return outputs.size() > output ? outputs[output].numbers : std::vector<float>();
}

inline void expectNumbers(const std::vector<float>& actual, const std::vector<float>& expected,
                          float tolerance = 2e-6f) {
    ASSERT_EQ(actual.size(), expected.size());
    for (size_t i = 0; i < actual.size(); ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance * std::max(1.0f, std::abs(expected[i])))
            << "component " << i;
}

/// A surface whose emission is the value of node "x".
inline Network emitting(std::vector<NetworkNode> nodes, const std::string& output = "") {
    nodes.push_back(makeNode("edf", "ND_uniform_edf", {}, {{"color", {"x", output}}}));
    nodes.push_back(makeNode("surface", "ND_surface", {}, {{"edf", {"edf", ""}}}));
    return makeNetwork(std::move(nodes));
}

/// The emission of such a surface at a point, with primvars by name.
inline glm::vec3 emitted(const Network& network, ShadingPoint point = {},
                         std::map<std::string, glm::vec4> primvars = {}) {
    Compiled c(network);
    EXPECT_EQ(c.diagnostics.count(), 0) << warnings(c.diagnostics);
    const FakePrimvars reader(*c.program, std::move(primvars));
    point.primvars = &reader;
    return c.program->emission(point, glm::vec3(0, 0, 1));
}

inline void expectVector(const glm::vec3& a, float x, float y, float z, float tolerance = 1e-5f) {
    EXPECT_NEAR(a.x, x, tolerance);
    EXPECT_NEAR(a.y, y, tolerance);
    EXPECT_NEAR(a.z, z, tolerance);
}

} // namespace patina
