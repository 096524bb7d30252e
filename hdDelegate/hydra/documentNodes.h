// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/mtlx/document.h"

#include <map>
#include <mutex>
#include <string>

namespace patina {

/// Nodes that MaterialX documents of a stage define, not Patina. OpenUSD's reader of MaterialX
/// tells Sdr of them and makes up identifiers; Sdr knows the document. Any thread.
class HdPatinaDocumentNodes {
public:
    /// @param identifier of a node that findNodeDef() does not know
    /// @returns its definition, null where no document of MaterialX has it. It lives as long as
    /// this.
    const ShadingModel* find(const std::string& identifier, Diagnostics& diagnostics);
    /// Replaces nodes that have the id of such a definition by its graph.
    Network expandIn(const Network& network, Diagnostics& diagnostics);

private:
    std::mutex _mutex;
    MtlxDefinitions _definitions;
    std::map<std::string, const ShadingModel*> _known; ///< by identifier
};

} // namespace patina
