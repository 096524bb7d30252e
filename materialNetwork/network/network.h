// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace patina {

/// Types of the values that flow through a material network.
enum class ValueType {
    Unknown,
    Bool,
    Int,
    Float,
    Vec2,
    Vec3,
    Vec4,
    Color3,
    Color4,
    Matrix33,
    Matrix44,
    String,
    Filename,
    Bsdf,
    Edf,
    Vdf,
    SurfaceShader,
    DisplacementShader,
    VolumeShader,
    LightShader,
    Material
};

const char* valueTypeName(ValueType type);         ///< MaterialX name: "float", "color3", "BSDF"...
ValueType valueTypeFromName(const std::string& s); ///< accepts MaterialX and Sdf type names
int valueTypeComponents(ValueType type);           ///< floats needed; 0 for strings and closures

/// A typed constant. Numbers of every type are stored as floats, row by row for matrices.
struct Value {
    ValueType type = ValueType::Unknown;
    std::vector<float> numbers;
    std::string text;       ///< strings, tokens and file names (resolved path)
    std::string colorSpace; ///< authored colour space of a colour or a file; empty when none

    static Value makeFloat(float x);
    static Value makeInt(int x);
    static Value makeBool(bool x);
    static Value makeVec2(float x, float y);
    static Value makeVec3(float x, float y, float z);
    static Value makeColor3(float r, float g, float b);
    static Value makeString(const std::string& s);
    static Value makeFilename(const std::string& s, const std::string& colorSpace = "");
};

/// Where an input is connected to: a node of the same network, and which of its outputs.
struct Connection {
    std::string node;
    std::string output; ///< empty means the node's only output
};

/// A node as authored: only authored inputs are there, defaults come from the node definition.
struct NetworkNode {
    std::string path; ///< unique in the network; prim path or document path
    std::string id;   ///< "UsdPreviewSurface", "ND_standard_surface_surfaceshader"...
    std::map<std::string, Value> inputs;
    std::map<std::string, Connection> connections;
};

/// A material as authored, in the shape of HdMaterialNetwork2.
/// Terminals: "surface", "displacement", "volume".
struct Network {
    std::string path; ///< path of the material prim, used in messages
    std::vector<NetworkNode> nodes;
    std::map<std::string, Connection> terminals;

    const NetworkNode* find(const std::string& nodePath) const;
    /// Adds a node. Where all are added so, find() takes a step for each, and none grow longer.
    /// @returns false, and adds nothing, where there is one of that path
    bool add(NetworkNode node);
    bool empty() const { return terminals.empty(); }

private:
    std::unordered_map<std::string, size_t> _places; ///< of nodes that add() added
};

} // namespace patina
