// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/dump.h"
#include "materialNetwork/graph/expand.h"
#include "materialNetwork/material.h"
#include "materialNetwork/graph/simplify.h"
#include "base/tests/testTools.h"
#include "shaders/tests/estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace patina {

/// Texels that show where they were read: (u, v, 0.5, 1). Files named "missing" do not exist.
class FakeTextures : public TextureSource {
public:
    int open(const TextureRequest& request) override {
        requests.push_back(request);
        return int(requests.size()) - 1;
    }
    bool valid(int handle) const override {
        return requests[size_t(handle)].file.find("missing") == std::string::npos;
    }
    glm::vec4 sample(int handle, glm::vec2 uv, float) const override {
        return valid(handle) ? glm::vec4(uv, 0.5f, 1.0f) : glm::vec4(1.0f, 0.0f, 1.0f, 1.0f);
    }
    int channels(int) const override { return 4; }
    std::shared_ptr<const EmissionProfile> openProfile(const TextureRequest& request) override {
        requests.push_back(request);
        return profile;
    }

    std::shared_ptr<const EmissionProfile> profile;

    std::vector<TextureRequest> requests;
};

/// Primvars by name.
class FakePrimvars : public PrimvarReader {
public:
    FakePrimvars(const MaterialProgram& program, std::map<std::string, glm::vec4> values)
        : _program(program), _values(std::move(values)) {}
    bool read(int slot, float out[4]) const override {
        const auto found = _values.find(_program.primvars()[size_t(slot)].name);
        if (found == _values.end()) return false;
        for (int i = 0; i < 4; ++i)
            out[i] = found->second[i];
        return true;
    }

private:
    const MaterialProgram& _program;
    std::map<std::string, glm::vec4> _values;
};

/// A point whose primvars are there by name.
class PointWith : public ShadingPoint {
public:
    PointWith(const MaterialProgram& program, std::map<std::string, glm::vec4> values,
              const ShadingPoint& point = {})
        : ShadingPoint(point), _reader(program, std::move(values)) {
        primvars = &_reader;
    }
    PointWith(const PointWith&) = delete;

private:
    FakePrimvars _reader;
};

/// The value of an input; numbers, switches and words have the types that they have in C++.
struct Given : Value {
    Given() = default;
    Given(Value value) : Value(std::move(value)) {}
    Given(float x) : Value(makeFloat(x)) {}
    Given(int x) : Value(makeInt(x)) {}
    Given(bool x) : Value(makeBool(x)) {}
    Given(const char* s) : Value(makeString(s)) {}
    Given(const std::string& s) : Value(makeString(s)) {}
};

/// What an input reads: "node", or "node.output" of a node that has several.
struct Link : Connection {
    Link() = default;
    Link(std::string node, std::string output) : Connection{std::move(node), std::move(output)} {}
    Link(const std::string& s) : Connection{s.substr(0, s.find('.')), ""} {
        if (node.size() < s.size()) output = s.substr(node.size() + 1);
    }
    Link(const char* s) : Link(std::string(s)) {}
};

using Inputs = std::map<std::string, Given>;
using Connections = std::map<std::string, Link>;

inline NetworkNode makeNode(const std::string& name, const std::string& id,
                            const Inputs& inputs = {}, const Connections& connections = {}) {
    NetworkNode node;
    node.path = "/m/" + name;
    node.id = id;
    node.inputs.insert(inputs.begin(), inputs.end());
    for (auto& [input, c] : connections)
        node.connections[input] = {"/m/" + c.node, c.output};
    return node;
}

/// A network whose surface terminal is the node of that name.
inline Network makeNetwork(std::vector<NetworkNode> nodes, const std::string& surface = "surface") {
    Network network;
    network.path = "/m";
    network.nodes = std::move(nodes);
    network.terminals["surface"] = {"/m/" + surface, ""};
    return network;
}

/// A surface of that model, and further nodes.
inline Network modelNetwork(const std::string& id, const Inputs& inputs = {},
                            const Connections& connections = {},
                            std::vector<NetworkNode> others = {}) {
    others.push_back(makeNode("surface", id, inputs, connections));
    return makeNetwork(std::move(others));
}

inline Network previewNetwork(const Inputs& inputs = {}, const Connections& connections = {},
                              std::vector<NetworkNode> others = {}) {
    return modelNetwork("UsdPreviewSurface", inputs, connections, std::move(others));
}

/// A surface that emits what node "edf" says.
inline Network edfNetwork(std::vector<NetworkNode> nodes) {
    return modelNetwork("ND_surface", {}, {{"edf", "edf"}}, std::move(nodes));
}

/// A surface made of one BSDF node called "bsdf", and of further nodes.
inline Network bsdfNetwork(std::vector<NetworkNode> nodes, const Inputs& surface = {}) {
    return modelNetwork("ND_surface", surface, {{"bsdf", "bsdf"}}, std::move(nodes));
}

/// A surface of a single lobe.
inline Network lobeNetwork(const std::string& id, const Inputs& inputs = {},
                           const Inputs& surface = {}) {
    return bsdfNetwork({makeNode("bsdf", id, inputs)}, surface);
}

inline NetworkNode layerNode(const std::string& name, const std::string& top,
                             const std::string& base) {
    return makeNode(name, "ND_layer_bsdf", {}, {{"top", top}, {"base", base}});
}

/// A surface whose BSDF is node "top" over node "base".
inline Network layered(std::vector<NetworkNode> nodes) {
    nodes.push_back(layerNode("bsdf", "top", "base"));
    return bsdfNetwork(std::move(nodes));
}

inline NetworkNode mixNode(const std::string& name, const std::string& fg, const std::string& bg,
                           float amount, const std::string& id = "ND_mix_bsdf") {
    return makeNode(name, id, {{"mix", amount}}, {{"fg", fg}, {"bg", bg}});
}

/// A node that reads two others, or one of them twice.
inline NetworkNode binaryNode(const std::string& name, const std::string& id, const Link& in1,
                              const Link& in2) {
    return makeNode(name, id, {}, {{"in1", in1}, {"in2", in2}});
}

inline NetworkNode diffuseNode(const std::string& name, const Value& color) {
    return makeNode(name, "ND_oren_nayar_diffuse_bsdf", {{"color", color}});
}

inline std::string numbered(const std::string& name, int i) {
    return name + std::to_string(i);
}

inline Value number(float x) {
    return Value::makeFloat(x);
}
inline Value pair(float x) {
    return Value::makeVec2(x, x);
}
inline Value vector(float x, float y) {
    return Value::makeVec2(x, y);
}
inline Value vector(float x, float y, float z) {
    return Value::makeVec3(x, y, z);
}
inline Value color4(float r, float g, float b, float a) {
    Value v;
    v.type = ValueType::Color4;
    v.numbers = {r, g, b, a};
    return v;
}
inline Value color(float r, float g, float b) {
    return Value::makeColor3(r, g, b);
}
inline Value grey(float x) {
    return Value::makeColor3(x, x, x);
}
inline Value text(const std::string& s) {
    return Value::makeString(s);
}
inline Value file(const std::string& s) {
    return Value::makeFilename(s);
}

inline ShadingPoint seenFrom(const glm::vec3& wo) {
    ShadingPoint point;
    point.viewDirection = wo;
    return point;
}

/// The lobes that a program has at a point.
inline Bsdf lobesAt(const MaterialProgram& program, const ShadingPoint& point = {}) {
    Bsdf bsdf;
    program.evaluate(point, bsdf);
    return bsdf;
}

/// A compiled network, and what was said and opened meanwhile.
struct Compiled {
    FakeTextures textures;
    Diagnostics diagnostics;
    std::shared_ptr<const MaterialProgram> program;

    explicit Compiled(const Network& network, const MethodChoices& methods = {},
                      double tolerance = -1.0)
        : program(compileMaterial(network, textures, diagnostics, methods, tolerance)) {}

    const MaterialProgram* operator->() const { return program.get(); }
    operator const Diagnostics&() const { return diagnostics; }
    Bsdf lobes(const ShadingPoint& point = {}) const { return lobesAt(*program, point); }
    Bsdf lobes(const glm::vec3& wo) const { return lobes(seenFrom(wo)); }
    glm::vec3 albedo(const glm::vec3& wo = {0, 0, 1}) const { return lobes(wo).albedo(); }
};

/// The same of a network about which there is nothing to say.
struct CleanCompiled : Compiled {
    explicit CleanCompiled(const Network& network, const MethodChoices& methods = {})
        : Compiled(network, methods) {
        EXPECT_TRUE(nothingTold(diagnostics));
    }
};

inline glm::vec3 albedoOf(const Network& network, const glm::vec3& wo = {0, 0, 1},
                          const MethodChoices& methods = {}) {
    return CleanCompiled(network, methods).albedo(wo);
}

inline void expectVector(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}
inline void expectVector(const glm::vec3& a, float x, float y, float z, float tolerance = 1e-5f) {
    expectVector(a, {x, y, z}, tolerance);
}

/// Direction at an angle to z, turned about it; degrees.
inline glm::vec3 direction(float theta, float phi = 0.0f) {
    const float t = glm::radians(theta), p = glm::radians(phi);
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// Its numbers by name.
struct Random : test::Random {
    using test::Random::Random;
    float next() { return (*this)(); }
    glm::vec3 next3() { return cube(); }
};

} // namespace patina
