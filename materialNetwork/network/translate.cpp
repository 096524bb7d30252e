// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/translate.h"

#include "materialNetwork/nodes/models.h"

namespace patina {

namespace {

const char* const hub = "standard_surface";

/// The node that the surface terminal leads to, through surfacematerial nodes.
const NetworkNode* surfaceNode(const Network& network) {
    const auto terminal = network.terminals.find("surface");
    if (terminal == network.terminals.end()) return nullptr;
    const NetworkNode* node = network.find(terminal->second.node);
    for (int guard = 0; node && guard < 8; ++guard) {
        const auto shader = node->connections.find("surfaceshader");
        if (shader == node->connections.end()) break;
        node = network.find(shader->second.node);
    }
    return node;
}

const ShadingModel* translator(const std::string& from, const std::string& to) {
    return ModelLibrary::get().find(from + "_to_" + to);
}

/// Feeds a node of the target from the outputs of a node that translates.
NetworkNode fed(const ShadingModel& by, const std::string& source, const std::string& path,
                const std::string& id) {
    NetworkNode node;
    node.path = path;
    node.id = id;
    for (const OutputDef& output : by.def.outputs)
        node.connections[output.name.substr(0, output.name.rfind("_out"))] = {source, output.name};
    return node;
}

} // namespace

std::vector<std::string> translatableModels() {
    std::vector<std::string> names = {hub};
    for (const auto& model : ModelLibrary::get().all()) {
        const std::string& name = model->def.category;
        const size_t at = name.find("_to_");
        if (at == std::string::npos || name.compare(0, at, hub) != 0) continue;
        names.push_back(name.substr(at + 4));
    }
    return names;
}

Network translateMaterial(const Network& network, const std::string& target,
                          Diagnostics& diagnostics) {
    Network empty;
    empty.path = network.path;
    const ModelLibrary& library = ModelLibrary::get();
    const NetworkNode* surface = surfaceNode(network);
    const ShadingModel* model = surface ? library.find(surface->id) : nullptr;
    const ShadingModel* wanted = library.find(target);
    if (!model || !wanted) {
        diagnostics.warn(surface ? surface->path : network.path, "",
                         !wanted ? messages::modelMissing(target) : messages::surfaceNoModel());
        return empty;
    }
    const std::string& source = model->def.category;
    if (source == target) return network;

    std::vector<const ShadingModel*> steps;
    if (const ShadingModel* direct = translator(source, target)) {
        steps = {direct};
    } else {
        steps = {translator(source, hub), translator(hub, target)};
        if (!steps[0] || !steps[1]) {
            diagnostics.warn(surface->path, "", messages::translationMissing(source, target));
            return empty;
        }
    }
    Network result;
    result.path = network.path;
    for (const NetworkNode& node : network.nodes)
        if (&node != surface) result.nodes.push_back(node);
    const auto freePath = [&](const ShadingModel& step) {
        std::string path = surface->path + "_" + step.def.category;
        while (network.find(path))
            path += "_";
        return path;
    };
    NetworkNode node = *surface;
    node.path = freePath(*steps[0]);
    node.id = steps[0]->def.id;
    for (size_t i = 1; i < steps.size(); ++i) {
        const std::string from = node.path;
        result.nodes.push_back(std::move(node));
        node = fed(*steps[i - 1], from, freePath(*steps[i]), steps[i]->def.id);
    }
    const std::string last = node.path;
    result.nodes.push_back(std::move(node));
    result.nodes.push_back(fed(*steps.back(), last, surface->path, wanted->def.id));
    result.terminals = network.terminals;
    result.terminals["surface"] = {surface->path, ""};
    return result;
}

} // namespace patina
