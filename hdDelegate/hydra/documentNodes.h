// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/models.h"

#include <map>
#include <mutex>
#include <set>
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

private:
    void read(const std::string& file, Diagnostics& diagnostics);

    std::mutex _mutex;
    std::set<std::string> _read;                 ///< files
    std::map<std::string, ShadingModel> _models; ///< by "file#definition"
    std::map<std::string, std::string> _names;   ///< keys of _models by identifier; "" for none
};

} // namespace patina
