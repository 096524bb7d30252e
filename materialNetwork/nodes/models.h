// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"
#include "materialNetwork/nodes/nodeDef.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// A node that is a graph of other nodes: a shading model, or a node definition of a document.
struct ShadingModel {
    /// Name of the "node" that a connection of the body has when it leads to an input of the model.
    static constexpr const char* interfaceNode = ".";

    NodeDef def;                    ///< inputs with defaults, outputs
    std::vector<NetworkNode> nodes; ///< paths are relative to the instance
    std::map<std::string, Connection> outputs;
};

/// A model file compiled into the library. The list ends with nulls.
struct EmbeddedModel {
    const char* name;
    const char* text;
};
extern const EmbeddedModel embeddedModels[];

/// All shading models: those of materialNetwork/models and, before them, those of the folders named
/// in the environment variable PATINA_MODEL_PATH (separated by colons). Read once.
class ModelLibrary {
public:
    static const ModelLibrary& get();

    /// @param id the name of the nodedef, or the node category that it defines
    const ShadingModel* find(const std::string& id) const;
    const ShadingModel* resolve(const std::string& category, ValueType outputType,
                                const std::map<std::string, ValueType>& inputTypes) const;
    /// Problems met while the models were read.
    const Diagnostics& diagnostics() const { return _diagnostics; }
    const std::vector<std::unique_ptr<ShadingModel>>& all() const { return _models; }

private:
    ModelLibrary();
    void add(const std::string& text, const std::string& path);

    std::vector<std::unique_ptr<ShadingModel>> _models;
    std::map<std::string, const ShadingModel*> _byId;
    Diagnostics _diagnostics;
};

/// The definition behind a shader id, of the table or of a shading model; null when unknown.
const NodeDef* findNodeDef(const std::string& id);

} // namespace patina
