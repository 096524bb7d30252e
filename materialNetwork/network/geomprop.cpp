// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/geomprop.h"

namespace patina {

NetworkNode geompropNode(const std::string& name) {
    NetworkNode node;
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

} // namespace patina
