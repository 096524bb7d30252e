// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/lightParams.h"

#include "hdDelegate/hydra/lightFilter.h"
#include "hdDelegate/hydra/lightPortals.h"
#include "hdDelegate/hydra/networkConversion.h"
#include "hdDelegate/hydra/values.h"

#include "materialNetwork/color/colorSpaces.h"
#include "base/maths.h"

#include <pxr/imaging/hd/light.h>
#include <pxr/imaging/hd/material.h>
#include <pxr/imaging/hd/tokens.h>
#include <pxr/usd/sdf/assetPath.h>

#include <cmath>

namespace patina {

namespace {

/// One light's parameters by name, checked.
class Params {
public:
    Params(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id)
        : _delegate(delegate), _param(param), _id(id) {}

    VtValue get(const char* name) const { return _delegate.GetLightParamValue(_id, TfToken(name)); }
    bool has(const char* name) const { return !get(name).IsEmpty(); }

    void number(const char* name, float& field) const {
        const VtValue value = get(name);
        if (value.IsEmpty()) return;
        double given = 0.0;
        if (!numberOf(value, given) || !std::isfinite(given))
            _param.warn(_id, name, messages::notFinite);
        else
            field = float(given);
    }
    void flag(const char* name, bool& field) const {
        double given = 0.0;
        if (numberOf(get(name), given)) field = given != 0.0;
    }
    void color(const char* name, vec3& field) const {
        const VtValue value = get(name);
        if (value.IsEmpty()) return;
        int components = 0;
        const std::vector<float> c = floatsOf(value, components);
        if (c.size() < 3 || !std::isfinite(c[0] + c[1] + c[2]))
            _param.warn(_id, name, messages::colorNotFinite);
        else
            field = vec3(c[0], c[1], c[2]);
    }
    void text(const char* name, std::string& field) const {
        const std::string given = textOf(get(name));
        if (!given.empty()) field = given;
    }

private:
    HdSceneDelegate& _delegate;
    HdPatinaRenderParam& _param;
    const SdfPath& _id;
};

LightType typeOf(const TfToken& type) {
    for (const LightRow& row : lightRows)
        if (type == row.hydra) return row.type;
    return LightType::Mesh;
}

void readInput(const Params& p, const char* name, float& field) {
    p.number(name, field);
}
void readInput(const Params& p, const char* name, bool& field) {
    p.flag(name, field);
}
void readInput(const Params& p, const char* name, vec3& field) {
    p.color(name, field);
}
void readInput(const Params& p, const char* name, std::string& field) {
    p.text(name, field);
}

void readInputs(const Params& p, Light& light) {
    // An applied ShapingAPI gives its cone angle, its fallback included.
    light.shapingConeAuthored =
        p.has("shaping:cone:angle") || p.has("shaping:focus") || p.has("shaping:ies:file");
    const bool image = light.type == LightType::Dome || light.type == LightType::Rect;
    enum class Group { Light, Shape, Shaping, Shadow, Image };
    const auto counts = [&](Group group) {
        return group == Group::Shaping ? light.shapingConeAuthored : group != Group::Image || image;
    };
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    if (counts(Group::group)) readInput(p, input, light.field);
#include "hdDelegate/scene/lightTypes.inc"
}

/// @param node that tells the spaces of colours; null: there is none
void convertColor(const HdMaterialNode* node, const char* input, HdPatinaRenderParam& param,
                  const SdfPath& id, vec3& color) {
    std::string space;
    if (node) {
        const auto given = node->parameters.find(TfToken(std::string("colorSpace:") + input));
        if (given != node->parameters.end()) space = textOf(given->second);
    }
    if (!ColorSpaces::shared().valueToRendering(space, param.renderingSpace(), &color.x))
        param.warn(id, std::string("inputs:") + input, messages::valueSpaceUnknown(space));
    else if (!ColorSpaces::isData(space))
        color = glm::max(color, vec3(0.0f)); // of what the rendering space does not reach
}

template <class T>
void convertColor(const HdMaterialNode*, const char*, HdPatinaRenderParam&, const SdfPath&, T&) {}

void convertColors(const HdMaterialNode* node, HdPatinaRenderParam& param, const SdfPath& id,
                   Light& light) {
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    convertColor(node, input, param, id, light.field);
#include "hdDelegate/scene/lightTypes.inc"
}

/// Lights are nodes of networks, which tell the colour spaces of their inputs, and what these are
/// connected to.
void readNetwork(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                 Light& light) {
    const VtValue resource = delegate.GetMaterialResource(id);
    const auto* map = resource.IsHolding<HdMaterialNetworkMap>()
                          ? &resource.UncheckedGet<HdMaterialNetworkMap>().map
                          : nullptr;
    const auto found = map ? map->find(HdMaterialTerminalTokens->light) : decltype(map->end()){};
    if (!map || found == map->end() || found->second.nodes.empty())
        return convertColors(nullptr, param, id, light);
    const HdMaterialNetwork& network = found->second;
    const HdMaterialNode& node = network.nodes.back();
    const auto group = node.parameters.find(TfToken("ri:light:lightGroup"));
    if (group != node.parameters.end()) light.lightGroup = textOf(group->second);
    const auto space = node.parameters.find(TfToken("colorSpace:texture:file"));
    if (space != node.parameters.end() && !light.textureFile.empty())
        light.textureColorSpace = textOf(space->second);
    convertColors(&node, param, id, light);
    if (node.identifier.GetString().compare(0, 3, "ND_") == 0)
        param.warn(id, "light:shaderId", messages::lightShaderIgnored(node.identifier.GetString()));
    if (!network.relationships.empty()) {
        light.network = networkOf(resource, id, param);
        const NetworkNode* self = light.network.find(light.network.terminals["light"].node);
        light.network.terminals = self ? self->connections : std::map<std::string, Connection>();
    }
}

/// Hosts differ in the name by which they give what is no input of UsdLux.
void readLightGroup(HdSceneDelegate& delegate, const Params& p, const SdfPath& id, Light& light) {
    for (const char* name :
         {"inputs:ri:light:lightGroup", "ri:light:lightGroup", "lightGroup", "primvars:lightGroup"})
        if (light.lightGroup.empty()) p.text(name, light.lightGroup);
    // The light of a mesh is a child that hosts do not know.
    const SdfPath owner = light.type == LightType::Mesh ? id.GetParentPath() : id;
    if (light.lightGroup.empty())
        light.lightGroup = textOf(delegate.Get(owner, TfToken("lightGroup")));
}

} // namespace

void readLightParams(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                     const TfToken& type, Light& light) {
    const Params p(delegate, param, id);
    Light fresh;
    fresh.path = light.path;
    fresh.group = light.group;
    fresh.transform = light.transform;
    light = fresh;
    light.type = typeOf(type);
    light.visible = delegate.GetVisible(id);

    readInputs(p, light);
    if (light.type == LightType::Mesh) {
        light.geometry = id.GetParentPath().GetString(); // our scene index made it a child
        p.text("materialSyncMode", light.materialSyncMode);
    }
    light.lightLink = textOf(delegate.GetLightParamValue(id, HdTokens->lightLink));
    light.shadowLink = textOf(delegate.GetLightParamValue(id, HdTokens->shadowLink));

    readNetwork(delegate, param, id, light);
    readLightGroup(delegate, p, id, light);
    light.filters = readLightFilters(delegate, param, id);
    if (light.type == LightType::Dome) light.portals = readLightPortals(delegate, param, id);

    bool seen = true; // by a render pass (plugin/hydra/renderPassSceneIndex.h)
    p.flag("patina:visibility:camera", seen);
    light.cameraVisible &= seen;
    // Hosts' own camera light carries what a rasterizer needs to know of it.
    if (light.type == LightType::Distant && p.has("params")) {
        light.diffuse = light.specular = pi;
        light.cameraVisible = false;
    }
}

} // namespace patina
