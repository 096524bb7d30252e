// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/mtlx/document.h"

#include "materialNetwork/graph/expand.h"
#include "base/limits.h"
#include "materialNetwork/mtlx/channels.h"
#include "materialNetwork/mtlx/include.h"
#include "materialNetwork/mtlx/parser.h"
#include "materialNetwork/mtlx/xmlFile.h"
#include "base/regularFile.h"

namespace patina {

bool parseMtlx(const std::string& text, const std::string& path, bool wantMaterials,
               MtlxDocument& out, Diagnostics& diagnostics, double metersPerUnit) {
    pugi::xml_document xml;
    std::string problem;
    if (!loadXml(text, xml, problem, limitOf(Limit::markup))) {
        diagnostics.warn(path, "", messages::documentIgnored(problem));
        return false;
    }
    pugi::xml_node root = xml.child("materialx");
    if (!root) {
        diagnostics.warn(path, "", messages::noMaterialx);
        return false;
    }
    includeDocuments(root, path, markupOf(text), diagnostics);
    channelsToSwizzles(root, path, diagnostics);
    MtlxParser(path, metersPerUnit, diagnostics).parse(root, wantMaterials, out);
    return true;
}

std::vector<Network> readMtlx(const std::string& path, Diagnostics& diagnostics,
                              double metersPerUnit) {
    std::string text, problem;
    if (!readRegularFile(path, Limit::documentBytes, text, problem)) {
        diagnostics.warn(path, "", messages::fileUnreadable(problem));
        return {};
    }
    MtlxDocument document;
    if (!parseMtlx(text, path, true, document, diagnostics, metersPerUnit)) return {};
    std::map<std::string, const ShadingModel*> models;
    for (const ShadingModel& model : document.models)
        models.emplace(model.def.id, &model);
    const auto find = [&](const std::string& id) -> const ShadingModel* {
        const auto found = models.find(id);
        return found == models.end() ? nullptr : found->second;
    };
    // Many materials of many nodes each would take as much as one that is given up.
    const size_t each = limitOf(Limit::nodes), maxNodes = 5 * each;
    size_t nodes = 0, leftOut = 0;
    for (Network& network : document.materials) {
        Network expanded;
        expanded.path = network.path;
        if (nodes <= maxNodes)
            expanded = expand(network, find, diagnostics);
        else
            ++leftOut;
        const bool givenUp = expanded.empty() && !network.empty();
        nodes += givenUp ? each : expanded.nodes.size();
        network = std::move(expanded);
    }
    if (leftOut)
        diagnostics.warn(path, "",
                         messages::expandedNodesTooMany(limitText(Limit::nodes), leftOut));
    return std::move(document.materials);
}

const ShadingModel* MtlxDefinitions::find(const std::string& file, const std::string& name,
                                          Diagnostics& diagnostics) {
    const auto idOf = [&](const std::string& definition) { return file + "#" + definition; };
    MtlxDocument document;
    std::string text, problem;
    if (_read.insert(file).second) {
        if (!readRegularFile(file, Limit::documentBytes, text, problem))
            diagnostics.warn(file, "", messages::fileUnreadable(problem));
        else
            parseMtlx(text, file, true, document, diagnostics); // so that they may use the library
    }
    std::set<std::string> own;
    for (const ShadingModel& model : document.models)
        own.insert(model.def.id);
    for (ShadingModel& model : document.models) {
        for (NetworkNode& node : model.nodes)
            if (own.count(node.id)) node.id = idOf(node.id);
        model.def.id = idOf(model.def.id);
        _models.emplace(model.def.id, std::move(model));
    }
    const auto found = _models.find(idOf(name));
    return found == _models.end() ? nullptr : &found->second;
}

Network MtlxDefinitions::expandIn(const Network& network, Diagnostics& diagnostics) const {
    const auto find = [&](const std::string& id) -> const ShadingModel* {
        const auto found = _models.find(id);
        return found == _models.end() ? nullptr : &found->second;
    };
    return expand(network, find, diagnostics);
}

std::vector<std::string> documentFiles(const std::string& path) {
    std::vector<std::string> files = {path};
    std::string text, problem;
    pugi::xml_document xml;
    Diagnostics told; // by readMtlx()
    if (readRegularFile(path, Limit::documentBytes, text, problem) &&
        loadXml(text, xml, problem, limitOf(Limit::markup)))
        includeDocuments(xml.child("materialx"), path, markupOf(text), told, &files);
    return files;
}

} // namespace patina
