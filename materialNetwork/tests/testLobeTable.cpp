// SPDX-License-Identifier: Apache-2.0
// The table of lobes: the nodes have what the setup of their lobe takes.

#include "materialNetwork/cpu/lobeSetup.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <type_traits>

using namespace patina;

namespace {

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
