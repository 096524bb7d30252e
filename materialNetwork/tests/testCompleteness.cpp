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

} // namespace patina
