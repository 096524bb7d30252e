// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/dump.h"
#include "materialNetwork/graph/expand.h"
#include "materialNetwork/material.h"
#include "materialNetwork/graph/simplify.h"

#include <gtest/gtest.h>

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

using Inputs = std::map<std::string, Value>;
using Connections = std::map<std::string, Connection>;

inline NetworkNode makeNode(const std::string& name, const std::string& id, Inputs inputs = {},
                            Connections connections = {}) {
    NetworkNode node;
    node.path = "/m/" + name;
    node.id = id;
    node.inputs = std::move(inputs);
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

inline Network previewNetwork(Inputs inputs = {}, Connections connections = {},
                              std::vector<NetworkNode> others = {}) {
    others.push_back(
        makeNode("surface", "UsdPreviewSurface", std::move(inputs), std::move(connections)));
    return makeNetwork(std::move(others));
}

/// A surface made of one BSDF node called "bsdf", and of further nodes.
inline Network bsdfNetwork(std::vector<NetworkNode> nodes, Inputs surface = {}) {
    nodes.push_back(
        makeNode("surface", "ND_surface", std::move(surface), {{"bsdf", {"bsdf", ""}}}));
    return makeNetwork(std::move(nodes));
}

inline Value number(float x) {
    return Value::makeFloat(x);
}
inline Value pair(float x) {
    return Value::makeVec2(x, x);
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

struct Compiled {
    FakeTextures textures;
    Diagnostics diagnostics;
    std::shared_ptr<const MaterialProgram> program;

    explicit Compiled(const Network& network, const MethodChoices& methods = {})
        : program(compileMaterial(network, textures, diagnostics, methods)) {}
};

inline std::string warnings(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& d : diagnostics.all())
        text += d.prim + " [" + d.input + "] " + d.message + "\n";
    return text;
}

/// Direction at an angle to z, turned about it; degrees.
inline glm::vec3 direction(float theta, float phi = 0.0f) {
    const float t = glm::radians(theta), p = glm::radians(phi);
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// A small generator whose numbers are the same everywhere.
class Random {
public:
    explicit Random(uint32_t seed) : _state(seed * 747796405u + 2891336453u) {}
    float next() {
        _state = _state * 747796405u + 2891336453u;
        uint32_t x = ((_state >> ((_state >> 28u) + 4u)) ^ _state) * 277803737u;
        x = (x >> 22u) ^ x;
        return float(x >> 8) * 0x1p-24f;
    }
    glm::vec3 next3() {
        const float a = next(), b = next(), c = next();
        return {a, b, c};
    }
    /// Uniform on the sphere.
    glm::vec3 direction() {
        const float z = 1.0f - 2.0f * next(), phi = 6.2831853f * next();
        const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    uint32_t _state;
};

} // namespace patina
