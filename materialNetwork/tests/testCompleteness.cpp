// SPDX-License-Identifier: Apache-2.0
// Every node definition of MaterialX is known, by table or by model, but for the ones named here.
#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace patina {

namespace {

// Lights of rasterizers, measured emission, and a model's helper, which is part of the model here.
const std::set<std::string> mayBeUnknown = {"ND_light", "ND_open_pbr_anisotropy"};

int rowsOf(ValueType type) {
    return type == ValueType::Matrix33 ? 3 : type == ValueType::Matrix44 ? 4 : 1;
}

/// Whether a register of the one type holds what a function takes or gives as the other.
bool fits(PatternType function, ValueType node, bool output) {
    const int n = valueTypeComponents(node);
    if (rowsOf(node) > 1 || patternRows(function) > 1) return rowsOf(node) == patternRows(function);
    const int size = function == PatternType::Vec2   ? 2
                     : function == PatternType::Vec3 ? 3
                     : function < PatternType::Vec2  ? 1
                                                     : 4;
    return size == 4 || n == 1 || (output ? size == 1 || n <= size : n >= size && size > 1);
}

} // namespace

TEST(Completeness, NodesOfMaterialX) {
    std::ifstream file(std::string(PATINA_EXPECTED_DIR) + "/materialxNodeIds.txt");
    ASSERT_TRUE(file);
    int count = 0;
    for (std::string id; std::getline(file, id);) {
        if (id.empty() || id[0] == '#') continue;
        ++count;
        const bool known = NodeTable::get().find(id) || ModelLibrary::get().find(id);
        EXPECT_TRUE(known || mayBeUnknown.count(id)) << id;
    }
    EXPECT_GT(count, 780);
}

/// A row and the function that it names are written in two places: their types belong together.
TEST(Completeness, FunctionsTakeAndGiveWhatTheirNodesHave) {
    for (const auto& def : NodeTable::get().all()) {
        if (!def->pattern) continue;
        std::vector<ValueType> inputs, outputs;
        for (const InputDef& input : def->inputs)
            if (!isTextType(input.type)) inputs.push_back(input.type);
        for (const OutputDef& output : def->outputs)
            if (!isTextType(output.type)) outputs.push_back(output.type);
        const Pattern& pattern = *def->pattern;
        size_t input = 0, output = 0;
        if (pattern.result != PatternType::None && !outputs.empty()) {
            EXPECT_TRUE(fits(pattern.result, outputs[output++], true)) << def->id << " returns";
        }
        for (int i = 0; i < pattern.parameterCount; ++i) {
            const PatternParameter& parameter = pattern.parameters[i];
            if (!parameter.output && !parameter.isInput()) continue;
            const auto& types = parameter.output ? outputs : inputs;
            size_t& at = parameter.output ? output : input;
            ASSERT_LT(at, types.size()) << def->id << " parameter " << i;
            EXPECT_TRUE(fits(parameter.type, types[at++], parameter.output))
                << def->id << " parameter " << i;
        }
        EXPECT_EQ(output, outputs.size()) << def->id;
    }
}

} // namespace patina
