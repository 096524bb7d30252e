// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/algebra.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/network/value.h"

namespace patina {

using Numbers = std::vector<float>;

/// Numbers of one output of a pattern node that reads nothing but its inputs.
inline Numbers folded(const std::string& id, const std::map<std::string, Numbers>& inputs,
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
    return outputs.size() > output ? outputs[output].numbers : Numbers();
}

inline void expectNumbers(const Numbers& actual, const Numbers& expected, float tolerance = 2e-6f) {
    ASSERT_EQ(actual.size(), expected.size());
    for (size_t i = 0; i < actual.size(); ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance * std::max(1.0f, std::abs(expected[i])))
            << "component " << i;
}

/// A pattern node gives these numbers.
inline void expectFolded(const std::string& id, const std::map<std::string, Numbers>& inputs,
                         const Numbers& expected, float tolerance = 2e-6f) {
    SCOPED_TRACE(id);
    expectNumbers(folded(id, inputs), expected, tolerance);
}

/// A surface whose emission is the value of node "x".
inline Network emitting(std::vector<NetworkNode> nodes, const std::string& output = "") {
    nodes.push_back(makeNode("edf", "ND_uniform_edf", {}, {{"color", {"x", output}}}));
    return edfNetwork(std::move(nodes));
}

/// The emission of such a surface at a point, with primvars by name.
inline glm::vec3 emitted(const Network& network, const ShadingPoint& point = {},
                         std::map<std::string, glm::vec4> primvars = {}) {
    const CleanCompiled c(network);
    return c->emission(PointWith(*c.program, std::move(primvars), point), {0, 0, 1});
}

/// Of a surface whose emission is the value of node `last`, a float or a vector.
inline Network showing(std::vector<NetworkNode> nodes, const std::string& last,
                       const char* type = "float") {
    nodes.push_back(
        makeNode("x", std::string("ND_convert_") + type + "_color3", {}, {{"in", last}}));
    return emitting(std::move(nodes));
}

} // namespace patina
