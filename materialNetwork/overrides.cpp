// SPDX-License-Identifier: Apache-2.0
// Inputs replaced from the command line.
#include "materialNetwork/material.h"

#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <algorithm>
#include <sstream>

namespace patina {

namespace {

const NodeDef* definition(const std::string& id) {
    if (const ShadingModel* model = ModelLibrary::get().find(id)) return &model->def;
    return NodeTable::get().find(id);
}

/// Through a surfacematerial to the surface of its front.
std::string surfaceOf(const Network& network, const std::string& path) {
    const NetworkNode* node = network.find(path);
    if (!node || node->id != "ND_surfacematerial") return path;
    const auto front = node->connections.find("surfaceshader");
    return front == node->connections.end() ? path : front->second.node;
}

/// Finds the node and input of "path.input" or "input".
/// @returns index into network.nodes, -1 when there is none
int findTarget(const Network& network, const std::string& target, std::string& input) {
    const size_t slash = target.rfind('/');
    const size_t point = target.rfind('.');
    std::string node;
    if (point != std::string::npos && (slash == std::string::npos || point > slash)) {
        node = target.substr(0, point);
        input = target.substr(point + 1);
    } else {
        const auto surface = network.terminals.find("surface");
        if (surface != network.terminals.end()) node = surfaceOf(network, surface->second.node);
        input = target;
    }
    // USD writes inputs with their namespace.
    if (input.rfind("inputs:", 0) == 0) input = input.substr(7);
    for (size_t i = 0; i < network.nodes.size(); ++i) {
        const std::string& path = network.nodes[i].path;
        const bool named = path == node || (path.size() > node.size() && !node.empty() &&
                                            path.compare(path.size() - node.size() - 1,
                                                         std::string::npos, "/" + node) == 0);
        if (!named) continue;
        const NodeDef* def = definition(network.nodes[i].id);
        if (def && def->findInput(input) >= 0) return int(i);
    }
    return -1;
}

} // namespace

bool parseOverride(const Network& network, const std::string& target, const std::string& text,
                   Value& out) {
    std::string input;
    const int node = findTarget(network, target, input);
    if (node < 0) return false;
    const NodeDef& def = *definition(network.nodes[size_t(node)].id);
    const InputDef& port = def.inputs[size_t(def.findInput(input))];
    const int n = valueTypeComponents(port.type);
    if (n == 0) {
        out = Value::makeString(text);
        out.type = port.type;
        return !isClosureType(port.type);
    }
    if (std::find(port.enumNames.begin(), port.enumNames.end(), text) != port.enumNames.end()) {
        out = Value::makeString(text);
        return true;
    }
    out = Value();
    out.type = port.type;
    if (port.type == ValueType::Bool && (text == "true" || text == "false")) {
        out.numbers = {text == "true" ? 1.0f : 0.0f};
        return true;
    }
    std::string plain = text;
    for (char& c : plain)
        if (c == ',' || c == '(' || c == ')') c = ' ';
    std::istringstream stream(plain);
    stream.imbue(std::locale::classic());
    for (float x; stream >> x;)
        out.numbers.push_back(x);
    if (!stream.eof() || (out.numbers.size() != 1 && int(out.numbers.size()) != n)) return false;
    out.numbers.resize(size_t(n), out.numbers[0]);
    return true;
}

Network applyOverrides(const Network& network, const MaterialOverrides& overrides,
                       Diagnostics& diagnostics) {
    Network result = network;
    for (const auto& [target, value] : overrides) {
        std::string input;
        const int node = findTarget(result, target, input);
        if (node < 0) {
            diagnostics.warn(network.path, target, messages::targetMissing);
            continue;
        }
        result.nodes[size_t(node)].inputs[input] = value;
        result.nodes[size_t(node)].connections.erase(input);
    }
    return result;
}

} // namespace patina
