// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/network/units.h"
#include "materialNetwork/nodes/models.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace patina {

/// The definitions and elements of a MaterialX document.
struct MtlxDocument {
    std::vector<ShadingModel> models; ///< node definitions with their graphs
    std::vector<Network> materials;   ///< one per material; node paths are "/graph/node"
};

/// Parses the text of a `.mtlx` document (1.38 or 1.39).
/// @param path of the file, for messages and relative file names
/// @param wantMaterials false to read only the node definitions (of a model library)
/// @param metersPerUnit of the scene, for distances that have a unit
/// @returns false, after a warning, if the text is no MaterialX document at all
bool parseMtlx(const std::string& text, const std::string& path, bool wantMaterials,
               MtlxDocument& out, Diagnostics& diagnostics, double metersPerUnit = 1.0);

/// Reads the materials of a `.mtlx` file. Node definitions of the document itself are expanded, so
/// the networks stand on their own. Network::path is "file:material name". A document without
/// materials gives one network per surface shader. Empty, after a warning, when unreadable.
std::vector<Network> readMtlx(const std::string& path, Diagnostics& diagnostics,
                              double metersPerUnit = 1.0);

/// Node definitions of documents whose materials come by another way.
class MtlxDefinitions {
public:
    /// @param file is read once
    /// @returns the definition, whose id is unlike those of other files; null when there is none
    const ShadingModel* find(const std::string& file, const std::string& name,
                             Diagnostics& diagnostics);
    /// Replaces nodes that have the id of a definition by its graph, as readMtlx() does.
    Network expandIn(const Network& network, Diagnostics& diagnostics) const;

private:
    std::set<std::string> _read; ///< files
    std::map<std::string, ShadingModel> _models;
};

/// The files that readMtlx() looks at: a document and all that it includes, readable or not.
std::vector<std::string> documentFiles(const std::string& path);

} // namespace patina
