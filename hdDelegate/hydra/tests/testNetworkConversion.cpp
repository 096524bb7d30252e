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
