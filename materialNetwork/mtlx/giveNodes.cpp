// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/giveNodes.h"

#include "base/limits.h"

#include <map>
#include <set>
#include <string>

namespace patina {

size_t giveNodes(const std::vector<NetworkNode>& nodes, std::vector<Network>& materials) {
    const size_t most = 5 * limitOf(Limit::nodes);
    size_t given = 0, leftOut = 0;
    std::map<std::string, size_t> places;
    for (size_t i = 0; i < nodes.size(); ++i)
        places.emplace(nodes[i].path, i);
    for (Network& material : materials) {
        std::set<size_t> reached;
        std::vector<size_t> open;
        const auto reach = [&](const Connection& c) {
            const auto found = places.find(c.node);
            if (found != places.end() && reached.insert(found->second).second)
                open.push_back(found->second);
        };
        for (const auto& [name, c] : material.terminals)
            reach(c);
        while (!open.empty()) {
            const NetworkNode& node = nodes[open.back()];
            open.pop_back();
            for (const auto& [input, c] : node.connections)
                reach(c);
        }
        if (given + reached.size() > most) {
            material.terminals.clear();
            ++leftOut;
            continue;
        }
        given += reached.size();
        for (const size_t i : reached)
            material.nodes.push_back(nodes[i]);
    }
    return leftOut;
}

} // namespace patina
