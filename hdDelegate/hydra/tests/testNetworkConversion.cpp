// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/networkConversion.h"

#include <gtest/gtest.h>
#include <pxr/imaging/hd/material.h>

using namespace patina;

/// One node reads thousands of others. The time that this takes must not grow with their square:
/// then it takes minutes.
TEST(NetworkConversion, ConnectsManyNodesToOne) {
    constexpr int count = 20000;
    const SdfPath material("/material");
    const TfToken out("out");
    HdMaterialNetwork part;
    for (int i = 0; i < count; ++i) {
        const SdfPath path("/material/node" + std::to_string(i));
        part.nodes.push_back({path, TfToken("ND_constant_float"), {}});
        part.relationships.push_back(
            {path, out, SdfPath("/material/wide"), TfToken("in" + std::to_string(i))});
    }
    // From a node that is none: nothing is connected to it.
    part.relationships.push_back(
        {SdfPath("/material/node0"), out, SdfPath("/material/lost"), TfToken("in")});
    part.nodes.push_back({SdfPath("/material/wide"), TfToken("ND_surface"), {}});
    HdMaterialNetworkMap map;
    map.map[HdMaterialTerminalTokens->surface] = part;
    // Terminals share nodes; scene indices name them within their material.
    part.nodes[0].path = SdfPath("node0");
    map.map[HdMaterialTerminalTokens->displacement] = part;

    HdPatinaRenderParam param;
    const Network network = networkOf(VtValue(map), material, param);
    ASSERT_EQ(network.nodes.size(), size_t(count + 1));
    for (const NetworkNode& node : network.nodes) {
        const bool isWide = node.path == "/material/wide";
        EXPECT_EQ(node.connections.size(), isWide ? size_t(count) : 0u) << node.path;
        if (isWide) {
            EXPECT_EQ(node.connections.at("in123").node, "/material/node123");
        }
    }
}

/// A network that does not say its version is of MaterialX 1.38, where switch has five inputs.
TEST(NetworkConversion, NetworksAreOf138UnlessTheySayOtherwise) {
    const SdfPath material("/material"), chosen("/material/chosen");
    HdMaterialNetwork part;
    part.nodes.push_back({chosen, TfToken("ND_atan2_float"), {{TfToken("in1"), VtValue(2.0f)}}});
    part.nodes.push_back({SdfPath("/material/surface"), TfToken("ND_surface_unlit"), {}});
    part.relationships.push_back({chosen, TfToken("out"), part.nodes[1].path, TfToken("emission")});
    HdMaterialNetworkMap map;
    map.map[HdMaterialTerminalTokens->surface] = part;
    HdPatinaRenderParam param;
    const Network old = networkOf(VtValue(map), material, param);
    EXPECT_EQ(old.nodes.at(0).inputs.count("iny"), 1u);
#if PXR_VERSION >= 2502
    map.config["mtlx:version"] = VtValue(std::string("1.39"));
    const Network current = networkOf(VtValue(map), material, param);
    EXPECT_EQ(current.nodes.at(0).inputs.count("in1"), 1u);
#endif
}
