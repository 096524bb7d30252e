// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/lightNetwork.h"

#include "materialNetwork/material.h"
#include "materialNetwork/nodes/models.h"

#include <algorithm>

namespace patina {

namespace {

/// Textures are asked for where an image is made.
class NoTextures : public TextureSource {
public:
    int open(const TextureRequest&) override { return 0; }
    bool valid(int) const override { return true; }
    glm::vec4 sample(int, glm::vec2, float) const override { return glm::vec4(0.0f); }
    int channels(int) const override { return 4; }
};

bool take(const vec3& value, float& field) {
    field = value.x;
    return true;
}
bool take(const vec3& value, bool& field) {
    field = value.x != 0.0f;
    return true;
}
bool take(const vec3& value, vec3& field) {
    field = value;
    return true;
}
bool take(const vec3&, std::string&) {
    return false;
}

bool givesNumbers(const Network& network, const Connection& source) {
    const NetworkNode* node = network.find(source.node);
    const NodeDef* def = node ? findNodeDef(node->id) : nullptr;
    if (!def || def->outputs.empty()) return false;
    const size_t output = size_t(std::max(def->findOutput(source.output), 0));
    return valueTypeComponents(def->outputs[output].type) > 0;
}

/// @returns whether the light has that input, and it takes numbers
bool take(const std::string& name, const vec3& value, Light& light) {
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    if (name == input) return take(value, light.field);
#include "hdDelegate/scene/lightTypes.inc"
    return false;
}

/// The material whose displacement is what nodes give an input: the only value of a material that
/// may be of any sign.
Network displacedBy(const Network& network, const std::string& input) {
    NetworkNode displacement, surface;
    displacement.path = network.path + "/displacement";
    displacement.id = "ND_displacement_vector3";
    displacement.connections["displacement"] = network.terminals.at(input);
    surface.path = network.path + "/surface";
    surface.id = "ND_surface";
    Network material;
    material.path = network.path;
    material.nodes = network.nodes;
    material.nodes.insert(material.nodes.end(), {displacement, surface});
    material.terminals = {{"displacement", {displacement.path, "out"}},
                          {"surface", {surface.path, "out"}}};
    return material;
}

} // namespace

std::shared_ptr<const Light> withNetworkValues(const Light& light, const RenderingSpace& space,
                                               Diagnostics& diagnostics) {
    auto result = std::make_shared<Light>(light);
    result->network = Network();
    const bool image = light.type == LightType::Dome || light.type == LightType::Rect;
    for (const auto& [input, source] : light.network.terminals) {
        const Network material = displacedBy(light.network, input);
        NoTextures textures;
        const auto program = givesNumbers(light.network, source)
                                 ? compileMaterial(material, textures, diagnostics, {}, -1.0, space)
                                 : nullptr;
        const bool varies = program && !program->ir().displacementCode.empty();
        if (varies && image && input == "color") {
            result->color = vec3(1.0f);
            result->network = material;
        } else if (!program || varies ||
                   !take(input, program->displacement(ShadingPoint()), *result)) {
            diagnostics.warn(light.path, "inputs:" + input,
                             messages::lightInputConnected(source.node));
        }
    }
    return result;
}

} // namespace patina
