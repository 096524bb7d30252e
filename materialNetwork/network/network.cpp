// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/network.h"

namespace patina {

namespace {

struct TypeRow {
    const char* name;
    ValueType type;
    int components;
};

// The first row of a type is its MaterialX name, further rows are Sdf names and older spellings.
const TypeRow typeRows[] = {
    {"unknown", ValueType::Unknown, 0},
    {"boolean", ValueType::Bool, 1},
    {"integer", ValueType::Int, 1},
    {"float", ValueType::Float, 1},
    {"vector2", ValueType::Vec2, 2},
    {"vector3", ValueType::Vec3, 3},
    {"vector4", ValueType::Vec4, 4},
    {"color3", ValueType::Color3, 3},
    {"color4", ValueType::Color4, 4},
    {"matrix33", ValueType::Matrix33, 9},
    {"matrix44", ValueType::Matrix44, 16},
    {"string", ValueType::String, 0},
    {"filename", ValueType::Filename, 0},
    {"BSDF", ValueType::Bsdf, 0},
    {"EDF", ValueType::Edf, 0},
    {"VDF", ValueType::Vdf, 0},
    {"surfaceshader", ValueType::SurfaceShader, 0},
    {"displacementshader", ValueType::DisplacementShader, 0},
    {"volumeshader", ValueType::VolumeShader, 0},
    {"lightshader", ValueType::LightShader, 0},
    {"material", ValueType::Material, 0},
    {"bool", ValueType::Bool, 1},
    {"int", ValueType::Int, 1},
    {"half", ValueType::Float, 1},
    {"double", ValueType::Float, 1},
    {"float2", ValueType::Vec2, 2},
    {"half2", ValueType::Vec2, 2},
    {"double2", ValueType::Vec2, 2},
    {"texCoord2f", ValueType::Vec2, 2},
    {"texCoord2h", ValueType::Vec2, 2},
    {"texCoord2d", ValueType::Vec2, 2},
    {"float3", ValueType::Vec3, 3},
    {"half3", ValueType::Vec3, 3},
    {"double3", ValueType::Vec3, 3},
    {"point3f", ValueType::Vec3, 3},
    {"point3h", ValueType::Vec3, 3},
    {"point3d", ValueType::Vec3, 3},
    {"vector3f", ValueType::Vec3, 3},
    {"vector3h", ValueType::Vec3, 3},
    {"vector3d", ValueType::Vec3, 3},
    {"normal3f", ValueType::Vec3, 3},
    {"normal3h", ValueType::Vec3, 3},
    {"normal3d", ValueType::Vec3, 3},
    {"texCoord3f", ValueType::Vec3, 3},
    {"texCoord3h", ValueType::Vec3, 3},
    {"texCoord3d", ValueType::Vec3, 3},
    {"float4", ValueType::Vec4, 4},
    {"half4", ValueType::Vec4, 4},
    {"double4", ValueType::Vec4, 4},
    {"color3f", ValueType::Color3, 3},
    {"color3h", ValueType::Color3, 3},
    {"color3d", ValueType::Color3, 3},
    {"color4f", ValueType::Color4, 4},
    {"color4h", ValueType::Color4, 4},
    {"color4d", ValueType::Color4, 4},
    {"matrix3d", ValueType::Matrix33, 9},
    {"matrix4d", ValueType::Matrix44, 16},
    {"token", ValueType::String, 0},
    {"asset", ValueType::Filename, 0},
    {"bsdf", ValueType::Bsdf, 0},
    {"edf", ValueType::Edf, 0},
    {"vdf", ValueType::Vdf, 0},
};

const TypeRow& rowOf(ValueType type) {
    for (const TypeRow& row : typeRows)
        if (row.type == type) return row;
    return typeRows[0];
}

Value makeNumbers(ValueType type, std::vector<float> numbers) {
    Value v;
    v.type = type;
    v.numbers = std::move(numbers);
    return v;
}

} // namespace

const char* valueTypeName(ValueType type) {
    return rowOf(type).name;
}

ValueType valueTypeFromName(const std::string& s) {
    for (const TypeRow& row : typeRows)
        if (s == row.name) return row.type;
    return ValueType::Unknown;
}

int valueTypeComponents(ValueType type) {
    return rowOf(type).components;
}

Value Value::makeFloat(float x) {
    return makeNumbers(ValueType::Float, {x});
}
Value Value::makeInt(int x) {
    return makeNumbers(ValueType::Int, {float(x)});
}
Value Value::makeBool(bool x) {
    return makeNumbers(ValueType::Bool, {x ? 1.0f : 0.0f});
}
Value Value::makeVec2(float x, float y) {
    return makeNumbers(ValueType::Vec2, {x, y});
}
Value Value::makeVec3(float x, float y, float z) {
    return makeNumbers(ValueType::Vec3, {x, y, z});
}
Value Value::makeColor3(float r, float g, float b) {
    return makeNumbers(ValueType::Color3, {r, g, b});
}

Value Value::makeString(const std::string& s) {
    Value v;
    v.type = ValueType::String;
    v.text = s;
    return v;
}

Value Value::makeFilename(const std::string& s, const std::string& colorSpace) {
    Value v = makeString(s);
    v.type = ValueType::Filename;
    v.colorSpace = colorSpace;
    return v;
}

const NetworkNode* Network::find(const std::string& nodePath) const {
    const auto found = _places.find(nodePath);
    if (found != _places.end() && found->second < nodes.size() &&
        nodes[found->second].path == nodePath)
        return &nodes[found->second];
    for (const NetworkNode& node : nodes)
        if (node.path == nodePath) return &node;
    return nullptr;
}

bool Network::add(NetworkNode node) {
    const bool all = _places.size() == nodes.size();
    if (all ? _places.count(node.path) > 0 : find(node.path) != nullptr) return false;
    if (all) _places.emplace(node.path, nodes.size());
    nodes.push_back(std::move(node));
    return true;
}

} // namespace patina
