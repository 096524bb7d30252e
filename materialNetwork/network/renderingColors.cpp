// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/renderingColors.h"

#include "materialNetwork/color/colorSpaces.h"
#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <set>

namespace patina {

namespace {

bool isColor(ValueType type) {
    return type == ValueType::Color3 || type == ValueType::Color4;
}

const NodeDef* definitionOf(const std::string& id) {
    if (const NodeDef* def = NodeTable::get().find(id)) return def;
    const ShadingModel* model = ModelLibrary::get().find(id);
    return model ? &model->def : nullptr;
}

/// MaterialX gives these the colour space "none", or makes them depend on the working space.
bool isDataInput(const std::string& name) {
    return name == "ior" || name == "extinction" || name == "lumacoeffs";
}

void convert(Value& value, const RenderingSpace& space) {
    if (value.numbers.size() < 3) return; // a number for all is grey, a broken one is told of later
    std::vector<float> numbers = value.numbers;
    if (!ColorSpaces::shared().valueToRendering(value.colorSpace, space, numbers.data())) return;
    value.numbers = std::move(numbers);
    value.colorSpace.clear();
}

void convertInputs(NetworkNode& node, const RenderingSpace& space) {
    const NodeDef* def = definitionOf(node.id);
    for (auto& [name, value] : node.inputs) {
        const int i = def ? def->findInput(name) : -1;
        const bool color = isColor(value.type) || (i >= 0 && isColor(def->inputs[size_t(i)].type));
        if (color && !isDataInput(name)) convert(value, space);
    }
    if (!def) return;
    for (const InputDef& input : def->inputs) {
        const std::vector<float>& c = input.value.numbers;
        if (!isColor(input.type) || isDataInput(input.name) || c.size() < 3 ||
            (c[0] == c[1] && c[1] == c[2]) || node.inputs.count(input.name) ||
            node.connections.count(input.name))
            continue;
        convert(node.inputs[input.name] = input.value, space);
    }
}

/// Nodes that take a source's colour, which is one of linear Rec.709, into the rendering space.
/// The last one's path is the source's with ".rendering".
void addConversion(Network& network, const std::string& source, const RenderingSpace& space) {
    NetworkNode in, turn, out;
    in.path = source + ".vector";
    in.id = "ND_convert_color3_vector3";
    in.connections["in"] = {source, ""};
    turn.path = source + ".turned";
    turn.id = "ND_transformmatrix_vector3";
    turn.connections["in"] = {in.path, ""};
    Value& matrix = turn.inputs["mat"];
    matrix.type = ValueType::Matrix33;
    for (int row = 0; row < 3; ++row) // rows of vectors that stand before the matrix
        for (int column = 0; column < 3; ++column)
            matrix.numbers.push_back(space.fromRec709[row][column]);
    out.path = source + ".rendering";
    out.id = "ND_convert_vector3_color3";
    out.connections["in"] = {turn.path, ""};
    for (NetworkNode* node : {&in, &turn, &out})
        network.nodes.push_back(std::move(*node));
}

} // namespace

Network inRenderingSpace(const Network& network, const RenderingSpace& space) {
    Network result;
    result.path = network.path;
    result.terminals = network.terminals;
    std::set<std::string> blackbodies;
    for (NetworkNode node : network.nodes) {
        const NodeDef* def = NodeTable::get().find(node.id);
        if (def && def->category == "blackbody") blackbodies.insert(node.path);
        convertInputs(node, space);
        result.nodes.push_back(std::move(node));
    }
    const auto redirect = [&](std::map<std::string, Connection>& connections) {
        for (auto& item : connections)
            if (blackbodies.count(item.second.node))
                item.second = {item.second.node + ".rendering", ""};
    };
    for (NetworkNode& node : result.nodes)
        redirect(node.connections);
    redirect(result.terminals);
    for (const std::string& path : blackbodies)
        addConversion(result, path, space);
    return result;
}

} // namespace patina
