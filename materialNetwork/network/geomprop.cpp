// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/geomprop.h"

#include "materialNetwork/shadingPoint.h"

#include <cstdlib>
#include <sstream>
#include <vector>

namespace patina {

namespace {

/// The parts of a customGeomprop(): name, type, geomprop, space, index.
NetworkNode customNode(const std::string& text) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, '/');)
        parts.push_back(part);
    parts.resize(5);
    NetworkNode node;
    node.id = "ND_" + (parts[2].empty() ? "geompropvalue" : parts[2]) + "_" + parts[1];
    if (parts[2].empty()) node.inputs["geomprop"] = Value::makeString(parts[0]);
    if (!parts[3].empty()) node.inputs["space"] = Value::makeString(parts[3]);
    if (!parts[4].empty()) node.inputs["index"] = Value::makeInt(std::atoi(parts[4].c_str()));
    return node;
}

} // namespace

std::string customGeomprop(const std::string& name, const std::string& type,
                           const std::string& geomprop, const std::string& space,
                           const std::string& index) {
    return name + "/" + type + "/" + geomprop + "/" + space + "/" + index;
}

NetworkNode geompropNode(const std::string& name) {
    NetworkNode node;
    if (name.find('/') != std::string::npos) node = customNode(name);
    node.path = "<" + name + ">";
    if (name == "UV0") {
        node.id = "ND_texcoord_vector2";
        return node;
    }
    static const struct {
        char letter;
        const char* id;
    } rows[] = {{'N', "ND_normal_vector3"},
                {'T', "ND_tangent_vector3"},
                {'B', "ND_bitangent_vector3"},
                {'P', "ND_position_vector3"},
                {'V', "ND_viewdirection_vector3"}};
    for (const auto& row : rows)
        for (const char* space : {"world", "object"})
            if (name == row.letter + std::string(space)) {
                node.id = row.id;
                node.inputs["space"] = Value::makeString(space);
            }
    return node;
}

std::string texcoordPrimvar(int index) {
    return index > 0 ? "st" + std::to_string(index) : "st";
}

namespace {
const std::string tangentsOf = "<tangent>";
} // namespace

std::string tangentPrimvar(const std::string& set) {
    return tangentsOf + set;
}

std::string setOfTangents(const std::string& primvar) {
    return primvar.compare(0, tangentsOf.size(), tangentsOf) == 0
               ? primvar.substr(tangentsOf.size())
               : std::string();
}

namespace {
const std::string matrixOf = "<space";
} // namespace

std::string spacePrimvar(const std::string& space, int row) {
    return matrixOf + std::to_string(row) + ">" + space;
}

std::string spaceOfPrimvar(const std::string& primvar) {
    const size_t name =
        primvar.compare(0, matrixOf.size(), matrixOf) == 0 ? primvar.find('>') : std::string::npos;
    return name == std::string::npos ? std::string() : primvar.substr(name + 1);
}

} // namespace patina
