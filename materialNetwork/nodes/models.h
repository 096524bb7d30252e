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
    std::string version;           ///< of the definition; mostly empty
    bool isDefaultVersion = false; ///< whether nodes that ask for no version get this one

    /// The name of the input that a token of the definition is; "[name]" in the texts of the body
    /// stands for its value.
    static std::string tokenInput(const std::string& name) { return "[" + name + "]"; }
};

/// The definition of a category that fits a node of a document best. A version that is asked for
/// counts more than the types; without one, the default version does.
class BestModel {
public:
    BestModel(ValueType outputType, const std::map<std::string, ValueType>& inputTypes,
              const std::string& version)
        : _outputType(outputType), _inputTypes(inputTypes), _version(version) {}
    void offer(const ShadingModel& model);
    const ShadingModel* model() const { return _best; }
    int fit() const { return _fit; } ///< as nodeDefFit()

private:
    ValueType _outputType;
    const std::map<std::string, ValueType>& _inputTypes;
    const std::string& _version;
    const ShadingModel* _best = nullptr;
    bool _rightVersion = false;
    int _fit = -1;
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
                                const std::map<std::string, ValueType>& inputTypes,
                                const std::string& version = "") const;
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
