// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/documentNodes.h"

#include "base/limits.h"
#include "base/regularFile.h"
#include "hdDelegate/hydra/assets.h"
#include "materialNetwork/mtlx/document.h"

#include <pxr/usd/sdr/registry.h>
#include <pxr/usd/sdr/shaderNode.h>

namespace patina {

const ShadingModel* HdPatinaDocumentNodes::find(const std::string& identifier,
                                                Diagnostics& diagnostics) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto own = _models.find(identifier); // of the body of another
    if (own != _models.end()) return &own->second;
    const auto [name, isNew] = _names.emplace(identifier, "");
    if (isNew) {
        const SdrShaderNodeConstPtr node =
            SdrRegistry::GetInstance().GetShaderNodeByIdentifier(TfToken(identifier));
        if (node && node->GetSourceType() == "mtlx") {
            const std::string& uri = node->GetResolvedImplementationURI();
            const std::string file = fileOf(SdfAssetPath(uri, uri));
            read(file, diagnostics);
            name->second = file + "#" + node->GetImplementationName();
        }
    }
    const auto found = _models.find(name->second);
    return found == _models.end() ? nullptr : &found->second;
}

void HdPatinaDocumentNodes::read(const std::string& file, Diagnostics& diagnostics) {
    std::string text, problem;
    if (!_read.insert(file).second) return;
    if (!readRegularFile(file, Limit::documentBytes, text, problem)) {
        diagnostics.warn(file, "", "the file " + problem);
        return;
    }
    MtlxDocument document;
    // Its materials come through Hydra; asked for, the definitions may use the library.
    if (!parseMtlx(text, file, true, document, diagnostics)) return;
    std::set<std::string> names;
    for (const ShadingModel& model : document.models)
        names.insert(model.def.id);
    for (ShadingModel& model : document.models) {
        for (NetworkNode& node : model.nodes) // documents may give the same name to others
            if (names.count(node.id)) node.id = file + "#" + node.id;
        const std::string name = file + "#" + model.def.id;
        _models.emplace(name, std::move(model));
    }
}

} // namespace patina
