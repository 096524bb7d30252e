// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/mtlx/document.h"

#include <pugixml.hpp>

#include <map>
#include <set>
#include <string>
#include <unordered_set>

namespace patina {

/// Reads the elements of one document. Used by parseMtlx() alone.
class MtlxParser {
public:
    MtlxParser(const std::string& path, double metersPerUnit, Diagnostics& diagnostics)
        : _path(path), _metersPerUnit(metersPerUnit), _diagnostics(diagnostics) {}

    void parse(const pugi::xml_node& root, bool wantMaterials, MtlxDocument& out);

private:
    using Element = pugi::xml_node;

    /// Where nodes are read: a graph (or the document itself) and how its interface is resolved.
    struct Scope {
        Element element;
        std::string prefix;      ///< of node paths
        bool functional = false; ///< the graph of a nodedef: interface names stay open
    };

    static bool isNode(const Element& element);
    static bool isPort(const Element& element);

    // definitions.cpp
    InputDef readInputDef(const Element& element, const std::string& id);
    /// Reads a definition on top of the one that it inherits from.
    /// @param depth how many inherit from each other until here
    void readDef(const Element& element, NodeDef& def, int depth);
    void readExtras();
    void readModel(const Element& graph, ShadingModel& model);
    void readDefinitions(const Element& root, MtlxDocument& out);
    void readGeomprops(const Element& root);
    void indexNames(const Element& root);
    std::string resolveId(const Element& element,
                          const std::map<std::string, ValueType>& inputTypes) const;
    std::string findDefinition(const Element& element, const std::string& category, ValueType type,
                               const std::map<std::string, ValueType>& inputTypes,
                               const std::string& version) const;
    std::string referenced(const Element& element, const std::string& name,
                           const std::map<std::string, Element>& known) const;

    // values.cpp
    /// @param id of the definition whose input gets the value, for its unit
    Value readValue(const Element& port, const std::string& id, const std::string& input);
    std::string readFile(const Element& port);
    const char* tokenOf(const Element& element, const std::string& name);
    double factorOf(const Element& port, const std::string& id, const std::string& input) const;
    void readUnits(const Element& root);
    std::string inherited(const Element& element, const char* attribute) const;
    bool isBefore139(const Element& element) const;

    // parser.cpp
    void readNodes(const Scope& scope, std::vector<NetworkNode>& nodes);
    void readNode(const Element& element, const Scope& scope, std::vector<NetworkNode>& nodes);
    /// @returns the inputs of a node, its own before those that it inherits
    std::vector<Element> portsOf(const Element& element);
    void readInput(const Element& input, const Scope& scope, NetworkNode& node);
    bool connect(const Element& port, const Scope& scope, Connection& out);
    bool connectInterface(const Element& port, const Scope& scope, NetworkNode& node,
                          const std::string& name);
    void readTokens(const Element& element, NetworkNode& node);
    void readMaterials(const Element& root, MtlxDocument& out);
    /// Sets an input by the value of an element, or by what that is connected to.
    void take(const Element& port, const Scope& scope, NetworkNode& node, const std::string& name);
    /// Names and texts are copied to each use of them. @returns whether so many bytes more may be
    bool hasRoom(size_t bytes);
    std::string where(const Element& element) const;

    std::string _path;
    double _metersPerUnit;
    Diagnostics& _diagnostics;
    std::multimap<std::string, const ShadingModel*> _models; ///< of the document, by category
    std::map<std::string, Element> _defs;    ///< node definitions by name, with namespace or not
    std::map<std::string, Element> _graphs;  ///< compound graphs of the document by name
    std::map<std::string, Element> _topmost; ///< nodes outside of graphs by name
    std::map<std::string, Element> _outputs; ///< outputs of the document by name
    /// What definitions say beside their inputs and outputs, by their name.
    struct DefExtras {
        std::map<std::string, std::string> units; ///< of inputs
        std::set<std::string> tokens;
    };
    std::map<std::string, DefExtras> _defExtras;
    std::map<std::string, Unit> _units;                ///< that the document defines
    std::map<std::string, std::string> _geomprops;     ///< the same, as geompropNode() takes them
    std::map<std::string, NetworkNode> _geompropNodes; ///< that graphs' inputs default to, by path
    /// Values of the tokens of elements that were asked for them.
    std::map<const void*, std::map<std::string, const char*>> _tokens;
    std::unordered_set<std::string> _before139; ///< paths of nodes of MaterialX 1.38
    bool _useLibrary = false;
    int _depth = 0;
    uint64_t _bytes = 0; ///< of names and texts of nodes
};

} // namespace patina
