// Every node definition of MaterialX is known, by table or by model, but for the ones named here.
#include "materialNetwork/models.h"
#include "materialNetwork/nodeTable.h"

#include <fstream>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace patina {

namespace {

// Lights of rasterizers, hair, directional emission, mixes of whole shaders; and a model's helper,
// which is part of the model here.
const std::set<std::string> mayBeUnknown = {"ND_light",
                                            "ND_chiang_hair_bsdf",
                                            "ND_chiang_hair_roughness",
                                            "ND_chiang_hair_absorption_from_color",
                                            "ND_deon_hair_absorption_from_melanin",
                                            "ND_conical_edf",
                                            "ND_measured_edf",
                                            "ND_generalized_schlick_edf",
                                            "ND_mix_surfaceshader",
                                            "ND_mix_displacementshader",
                                            "ND_mix_volumeshader",
                                            "ND_open_pbr_anisotropy"};

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
