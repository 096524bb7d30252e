// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/documentNodes.h"

#include "hdDelegate/hydra/assets.h"

#include <pxr/usd/sdr/registry.h>
#include <pxr/usd/sdr/shaderNode.h>

namespace patina {

const ShadingModel* HdPatinaDocumentNodes::find(const std::string& identifier,
                                                Diagnostics& diagnostics) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto [known, isNew] = _known.emplace(identifier, nullptr);
    if (!isNew) return known->second;
    const SdrShaderNodeConstPtr node =
        SdrRegistry::GetInstance().GetShaderNodeByIdentifier(TfToken(identifier));
    if (node && node->GetSourceType() == "mtlx") {
        const std::string& uri = node->GetResolvedImplementationURI();
        known->second = _definitions.find(fileOf(SdfAssetPath(uri, uri)),
                                          node->GetImplementationName(), diagnostics);
    }
    return known->second;
}

Network HdPatinaDocumentNodes::expandIn(const Network& network, Diagnostics& diagnostics) {
    const std::lock_guard<std::mutex> lock(_mutex);
    return _definitions.expandIn(network, diagnostics);
}

} // namespace patina
