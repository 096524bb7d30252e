// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/mtlx/document.h"

#include <pugixml.hpp>

#include <map>
#include <string>

namespace patina {

/// Reads the elements of one document. Used by parseMtlx() alone.
class MtlxParser {
public:
    MtlxParser(const std::string& path, Diagnostics& diagnostics)
        : _path(path), _diagnostics(diagnostics) {}

    void parse(const pugi::xml_node& root, bool wantMaterials, MtlxDocument& out);

private:
    using Element = pugi::xml_node;

    /// Where nodes are read: a graph (or the document itself) and how its interface is resolved.
    struct Scope {
        Element element;
        std::string prefix;      ///< of node paths
        bool functional = false; ///< the graph of a nodedef: interface names stay open
    };

    void readDef(const Element& element, NodeDef& def) const;
    void readModel(const Element& graph, const NodeDef& def, ShadingModel& model);
    void readNodes(const Scope& scope, std::vector<NetworkNode>& nodes);
    void readNode(const Element& element, const Scope& scope, std::vector<NetworkNode>& nodes);
    void readInput(const Element& input, const Scope& scope, NetworkNode& node);
    bool connect(const Element& port, const Scope& scope, Connection& out);
    bool connectInterface(const Element& port, const Scope& scope, NetworkNode& node,
                          const std::string& name);
    std::string resolveId(const Element& element,
                          const std::map<std::string, ValueType>& inputTypes) const;
    std::string findDefinition(const std::string& category, ValueType type,
                               const std::map<std::string, ValueType>& inputTypes) const;
    std::string referenced(const Element& element, const std::string& name,
                           const std::map<std::string, Element>& known) const;
    void readMaterials(const Element& root, MtlxDocument& out);
    void indexNames(const Element& root);
    /// Sets an input by the value of an element, or by what that is connected to.
    void take(const Element& port, const Scope& scope, NetworkNode& node, const std::string& name);
    /// Names and texts are copied to each use of them. @returns whether so many bytes more may be
    bool hasRoom(size_t bytes);
    Value readValue(const Element& port) const;
    std::string inherited(const Element& element, const char* attribute) const;
    std::string where(const Element& element) const;

    std::string _path;
    Diagnostics& _diagnostics;
    std::multimap<std::string, const ShadingModel*> _models; ///< of the document, by category
    std::map<std::string, Element> _defs;    ///< node definitions by name, with namespace or not
    std::map<std::string, Element> _graphs;  ///< compound graphs of the document by name
    std::map<std::string, Element> _topmost; ///< nodes outside of graphs by name
    bool _useLibrary = false;
    int _depth = 0;
    uint64_t _bytes = 0; ///< of names and texts of nodes
};

} // namespace patina
