// SPDX-License-Identifier: Apache-2.0
// Every node definition of MaterialX is known, by table or by model, but for those that
// notDrawn.inc names; rows have what the functions behind them take.
#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/notDrawn.h"
#include "materialNetwork/network/value.h"

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

using namespace patina;

namespace {

/// One definition of the table of MaterialX's own.
struct Expected {
    std::string id, category;
    std::vector<InputDef> inputs;
    std::vector<bool> valued; ///< inputs with a default
    std::vector<OutputDef> outputs;
};

/// @param text a row of materialxDefinitions.txt (testenv/materialxDefinitions.py)
Expected expectedFrom(const std::string& text) {
    Expected def;
    std::istringstream parts(text);
    std::getline(parts, def.id, '|');
    std::getline(parts, def.category, '|');
    for (std::string part; std::getline(parts, part, '|');) {
        const bool isOutput = part[0] == '>';
        const size_t space = part.find(' '), equals = part.find('=');
        const ValueType type = valueTypeFromName(part.substr(isOutput, space - isOutput));
        const std::string name = part.substr(space + 1, equals - space - 1);
        if (isOutput) {
            def.outputs.push_back({name, type});
            continue;
        }
        InputDef input;
        input.name = name;
        input.type = type;
        const std::string value = equals == std::string::npos ? "" : part.substr(equals + 1);
        if (!value.empty() && value[0] == '@') input.geomprop = value.substr(1);
        input.value.text = value;
        std::istringstream numbers(value);
        for (float x; numbers >> x;)
            input.value.numbers.push_back(x);
        if (input.value.numbers.size() == 1)
            input.value.numbers.resize(size_t(std::max(1, valueTypeComponents(type))),
                                       input.value.numbers[0]);
        def.inputs.push_back(input);
        def.valued.push_back(!value.empty() && input.geomprop.empty());
    }
    return def;
}

/// Inputs of 1.38 that the upgrade takes, and those that say what is meant otherwise here.
bool isUpgraded(const std::string& category, const std::string& input) {
    return (category == "atan2" && (input == "in1" || input == "in2")) ||
           (category == "normalmap" && input == "space") || category == "swizzle";
}

/// Nodes whose definition says less of its types: vector4 and color4 have one register.
bool sameType(ValueType a, ValueType b) {
    return a == b || (valueTypeComponents(a) > 1 && coercion(a, b) == Coercion::Free &&
                      valueTypeComponents(a) == valueTypeComponents(b));
}

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

template <class T> void takeOne(std::vector<int>& sizes) {
    if (std::is_same_v<T, float>) sizes.push_back(1);
    if (std::is_same_v<T, glm::vec2>) sizes.push_back(2);
    if (std::is_same_v<T, glm::vec3>) sizes.push_back(3);
}

/// Components of the arguments that are numbers.
template <class L, class... A> std::vector<int> taken(L (*)(A...)) {
    std::vector<int> sizes;
    (takeOne<A>(sizes), ...);
    return sizes;
}

struct Row {
    LobeKind kind;
    std::vector<int> taken;
};

std::vector<Row> rows() {
    return {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) {LobeKind::Kind, taken(&sh::prefix##Setup)},
#include "materialNetwork/lobeTable.inc"
    };
}

} // namespace

TEST(Completeness, NodesOfMaterialX) {
    std::ifstream file(std::string(PATINA_EXPECTED_DIR) + "/materialxDefinitions.txt");
    ASSERT_TRUE(file);
    int count = 0, notDrawn = 0;
    std::set<std::string> seen; // of 1.39
    bool isOld = false;
    for (std::string line; std::getline(file, line);) {
        isOld |= line.compare(0, 6, "# 1.38") == 0;
        if (line.empty() || line[0] == '#') continue;
        ++count;
        const Expected expected = expectedFrom(line);
        if (!isOld) seen.insert(expected.id);
        // As MaterialX's own upgrade, ours gives an input that is not authored the default of 1.39.
        // A translation has the defaults of the model that it reads.
        const bool hasOtherDefaults = (isOld && seen.count(expected.id)) ||
                                      expected.category.find("_to_") != std::string::npos;
        const NodeDef* def = findNodeDef(expected.id);
        EXPECT_NE(def != nullptr, whyNotDrawn(expected.id) != nullptr) << expected.id;
        if (!def) {
            ++notDrawn;
            continue;
        }
        for (size_t i = 0; i < expected.inputs.size(); ++i) {
            const InputDef& wanted = expected.inputs[i];
            const std::string where = expected.id + " " + wanted.name;
            if (isUpgraded(expected.category, wanted.name)) continue;
            const int place = def->findInput(wanted.name);
            EXPECT_GE(place, 0) << where;
            if (place < 0) continue;
            const InputDef& input = def->inputs[size_t(place)];
            EXPECT_TRUE(sameType(wanted.type, input.type)) << where;
            EXPECT_EQ(hasOtherDefaults ? input.geomprop : wanted.geomprop, input.geomprop) << where;
            if (hasOtherDefaults || !expected.valued[i]) continue;
            if (valueTypeComponents(wanted.type) == 0) {
                EXPECT_EQ(wanted.value.text, input.value.text) << where;
                continue;
            }
            ASSERT_EQ(wanted.value.numbers.size(), input.value.numbers.size()) << where;
            for (size_t k = 0; k < wanted.value.numbers.size(); ++k)
                EXPECT_FLOAT_EQ(wanted.value.numbers[k], input.value.numbers[k]) << where;
        }
        for (const OutputDef& wanted : expected.outputs) {
            const int place = def->findOutput(wanted.name);
            EXPECT_GE(place, 0) << expected.id << " > " << wanted.name;
            if (place < 0) continue;
            EXPECT_TRUE(sameType(wanted.type, def->outputs[size_t(place)].type))
                << expected.id << " > " << wanted.name;
        }
    }
    EXPECT_GT(count, 900);
    EXPECT_GT(notDrawn, 25);
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

TEST(LobeTable, inputsAreTheArgumentsOfSetup) {
    for (const Row& row : rows()) {
        const std::vector<std::string>& names = lobeParameters(row.kind);
        ASSERT_LE(names.size(), size_t(LobeTemplate::maxParameters)) << lobeRow(row.kind).prefix;
        ASSERT_GE(names.size(), row.taken.size()) << lobeRow(row.kind).prefix;
        const auto& defs = NodeTable::get().all();
        const auto def = std::find_if(defs.begin(), defs.end(), [&](const auto& d) {
            return isLobe(d->closure) && lobeKind(d->closure) == row.kind;
        });
        ASSERT_NE(def, defs.end()) << lobeRow(row.kind).prefix;
        for (size_t i = 0; i < row.taken.size(); ++i) {
            const InputDef& input = (*def)->inputs[size_t((*def)->findInput(names[i]))];
            EXPECT_EQ(valueTypeComponents(input.type), row.taken[i])
                << (*def)->id << " " << input.name;
        }
    }
}

TEST(LobeTable, defaultsAreAmongTheWords) {
    int lists = 0;
    for (const auto& def : NodeTable::get().all())
        for (const InputDef& input : def->inputs) {
            if (input.words.empty()) continue;
            ++lists;
            EXPECT_EQ(input.words[size_t(wordIndex(input, input.value.text))], input.value.text)
                << def->id << " " << input.name;
        }
    EXPECT_GT(lists, 0);
    const NodeDef* transmits = NodeTable::get().find("ND_dielectric_btdf");
    ASSERT_TRUE(transmits);
    const InputDef& mode = transmits->inputs[size_t(transmits->findInput("scatter_mode"))];
    EXPECT_EQ(mode.value.text, "T");
    EXPECT_EQ(mode.words, (std::vector<std::string>{"R", "T", "RT"}));
}
