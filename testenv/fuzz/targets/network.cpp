// SPDX-License-Identifier: Apache-2.0
// Bytes as a network of nodes that are known: any of them, with values of their inputs' types or of
// others, connected or not, in cycles too.
#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "testenv/fuzz/targets/choices.h"
#include "testenv/fuzz/targets/targets.h"
#include "testenv/fuzz/targets/useMaterial.h"

#include <cstring>
#include <limits>

namespace patina {

namespace {

const std::vector<const NodeDef*>& definitions() {
    static const std::vector<const NodeDef*> all = [] {
        std::vector<const NodeDef*> found;
        for (const auto& def : NodeTable::get().all())
            found.push_back(def.get());
        for (const auto& model : ModelLibrary::get().all())
            found.push_back(&model->def);
        return found;
    }();
    return all;
}

float number(Choices& bytes) {
    using limits = std::numeric_limits<float>;
    static const float special[] = {0.0f,
                                    -0.0f,
                                    1.0f,
                                    -1.0f,
                                    0.5f,
                                    0.18f,
                                    2.0f,
                                    1e-3f,
                                    1e-7f,
                                    -1e-7f,
                                    1e-20f,
                                    limits::denorm_min(),
                                    limits::min(),
                                    1e6f,
                                    1e20f,
                                    limits::max(),
                                    -limits::max(),
                                    limits::infinity(),
                                    -limits::infinity(),
                                    limits::quiet_NaN(),
                                    0.99999994f,
                                    1.0000001f,
                                    16777216.0f,
                                    2147483648.0f};
    if (bytes.flag()) return special[bytes.below(int(sizeof special / sizeof *special))];
    const uint32_t bits = bytes.bits();
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

Value valueOf(Choices& bytes, ValueType type) {
    if (bytes.below(16) == 0) type = ValueType(bytes.below(1 + int(ValueType::Material)));
    Value value;
    value.type = type;
    for (int i = 0, count = valueTypeComponents(type); i < count; ++i)
        value.numbers.push_back(number(bytes));
    if (type == ValueType::String || type == ValueType::Filename) value.text = bytes.text(24);
    if (bytes.below(32) == 0) value.colorSpace = bytes.text(12);
    return value;
}

Network networkOf(Choices& bytes) {
    Network network;
    network.path = "/m";
    const int count = 1 + bytes.below(12);
    const auto nodeName = [&](int i) { return "/m/n" + std::to_string(i); };
    for (int i = 0; i < count; ++i) {
        const NodeDef& def = *definitions()[size_t(bytes.below(int(definitions().size())))];
        NetworkNode node;
        node.path = nodeName(i);
        node.id = def.id;
        for (const InputDef& input : def.inputs) {
            const int choice = bytes.below(4);
            if (choice == 1) node.inputs[input.name] = valueOf(bytes, input.type);
            if (choice == 2 || (choice == 3 && isClosureType(input.type)))
                node.connections[input.name] = {nodeName(bytes.below(1 + count)), ""};
        }
        network.nodes.push_back(std::move(node));
    }
    // The end of the graph: the last node as a surface, behind one, or a displacement.
    const char* const terminals[] = {"surface", "displacement", "volume"};
    network.terminals[terminals[bytes.below(3)]] = {nodeName(count - 1), ""};
    NetworkNode surface;
    surface.path = "/m/s";
    surface.id = "ND_surface";
    surface.connections["bsdf"] = {nodeName(bytes.below(count)), ""};
    surface.connections["edf"] = {nodeName(bytes.below(count)), ""};
    network.nodes.push_back(surface);
    network.terminals.emplace("surface", Connection{"/m/s", ""});
    return network;
}

} // namespace

} // namespace patina

bool fuzzNetwork(const uint8_t* data, size_t size) {
    patina::Choices bytes(data, size);
    const patina::Network network = patina::networkOf(bytes);
    std::string source;
    for (const patina::NetworkNode& node : network.nodes)
        for (const auto& input : node.inputs)
            source += input.second.text + "\n" + input.second.colorSpace + "\n";
    patina::useMaterial(network, source);
    return true;
}
