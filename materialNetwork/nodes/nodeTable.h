// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/nodeDef.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// One row of the table of node definitions, as it is written in materialNetwork/nodes.
///
/// Inputs and outputs are text: "color3 color=.18, float roughness=0, vector3 normal=@Nworld,
/// string mode=R". One number stands for all components; a space separates components; `@` names a
/// default geometric property, `|` separates the words that a string may be, of which `*` marks the
/// default where it is not the first. `$` in id, inputs and outputs stands for each of the types in
/// turn.
struct NodeRow {
    const char* id;
    const char* category;
    const char* inputs;
    const char* outputs; ///< "float out" or just "float", which is named out
    Pattern pattern = nullptr;
    Algebra algebra = Algebra::None;
    const char* types = nullptr; ///< for `$`, separated by spaces
    PatternPrepare prepare = nullptr;
    ClosureKind closure = ClosureKind::None;
};

/// All node definitions that are not shading models. Built once; read only afterwards.
class NodeTable {
public:
    static const NodeTable& get();

    /// @param id "ND_..." id, an alias, or a USD shader id. @returns null when unknown
    const NodeDef* find(const std::string& id) const;

    /// @returns the definition of a category whose outputs and inputs fit best, or null
    /// @param outputType type of the node element in a document ("multioutput" gives Unknown)
    const NodeDef* resolve(const std::string& category, ValueType outputType,
                           const std::map<std::string, ValueType>& inputTypes) const;

    const std::vector<std::unique_ptr<NodeDef>>& all() const { return _defs; }
    /// Every id that find() knows, aliases too.
    const std::map<std::string, const NodeDef*>& ids() const { return _byId; }

private:
    NodeTable();
    void add(const NodeRow& row);
    void addOne(const NodeRow& row, const std::string& type);
    void alias(const char* name, const char* id);

    std::vector<std::unique_ptr<NodeDef>> _defs;
    std::map<std::string, const NodeDef*> _byId;
    std::multimap<std::string, const NodeDef*> _byCategory;
};

/// How well a definition fits a node as written in a document: -1 not at all, higher is better.
int nodeDefFit(const NodeDef& def, ValueType outputType,
               const std::map<std::string, ValueType>& inputTypes);

/// A span of rows; every family of nodes is one such function in materialNetwork/nodes.
struct NodeRows {
    const NodeRow* begin;
    const NodeRow* end;
};
NodeRows mathNodes();
NodeRows vectorNodes();
NodeRows channelNodes();
NodeRows conditionalNodes();
NodeRows geometryNodes();
NodeRows textureNodes();
NodeRows usdNodes();
NodeRows helperNodes();
NodeRows noiseNodes();
NodeRows shapeNodes();
NodeRows colorNodes();
NodeRows placedImageNodes();
NodeRows hexTileNodes();
NodeRows matrixNodes();
NodeRows spaceNodes();
NodeRows differenceNodes();
NodeRows closureNodes();
NodeRows hairNodes();
NodeRows legacyNodes();

/// Types that most stdlib families have.
inline constexpr const char* allTypes = "float color3 color4 vector2 vector3 vector4";
inline constexpr const char* tupleTypes = "color3 color4 vector2 vector3 vector4";

} // namespace patina
