// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/graph/namedSpaces.h"

#include "materialNetwork/shadingPoint.h"

#include <set>

namespace patina {

namespace {

struct Row {
    const char* id;
    const char* kind; ///< "point", "vector" or "normal"
    bool transforms;  ///< from one space to another; else it reads the surface in one
};

constexpr Row rows[] = {
    {"ND_position_vector3", "point", false},       {"ND_tangent_vector3", "vector", false},
    {"ND_bitangent_vector3", "vector", false},     {"ND_normal_vector3", "normal", false},
    {"ND_transformpoint_vector3", "point", true},  {"ND_transformvector_vector3", "vector", true},
    {"ND_transformnormal_vector3", "normal", true}};

/// @returns the name of a coordinate system; empty for MaterialX's own spaces
std::string spaceOf(const NetworkNode& node, const char* input) {
    const auto found = node.inputs.find(input);
    if (found == node.inputs.end()) return {};
    const std::string& name = found->second.text;
    return name == "object" || name == "model" || name == "world" ? std::string() : name;
}

class Resolver {
public:
    explicit Resolver(Network& network) : _network(network) {
        for (const NetworkNode& node : network.nodes)
            _known.insert(node.path);
    }

    void run() {
        const size_t count = _network.nodes.size();
        for (size_t i = 0; i < count; ++i)
            for (const Row& row : rows)
                if (_network.nodes[i].id == row.id) resolve(i, row);
    }

private:
    using Links = std::map<std::string, Connection>;
    using Values = std::map<std::string, Value>;

    void resolve(size_t index, const Row& row) {
        const NetworkNode node = _network.nodes[index];
        _kind = row.kind;
        _prefix = node.path + ".";
        const std::string to = spaceOf(node, row.transforms ? "tospace" : "space");
        const std::string from = row.transforms ? spaceOf(node, "fromspace") : std::string();
        if (to.empty() && from.empty()) return;
        Connection value;
        if (!row.transforms) {
            value = add("world", node.id, node.connections, node.inputs);
            _network.nodes.back().inputs["space"] = Value::makeString("world");
        } else {
            value = add("in", "ND_dot_vector3", {}, {});
            NetworkNode& in = _network.nodes.back();
            if (node.inputs.count("in")) in.inputs["in"] = node.inputs.at("in");
            if (node.connections.count("in")) in.connections["in"] = node.connections.at("in");
        }
        const auto plain = [&](const char* input) {
            const auto found = node.inputs.find(input);
            return found == node.inputs.end() ? std::string() : found->second.text;
        };
        std::string space = row.transforms ? plain("fromspace") : "world";
        if (!from.empty()) {
            value = applied("from", value, from, true);
            const std::string next = to.empty() ? plain("tospace") : "world";
            value = mixed("from", from, transformed("fromWorld", value, "world", next),
                          transformed("fromObject", value, "object", next));
            space = next;
        }
        if (!to.empty()) {
            value = mixed("to", to, transformed("toWorld", value, space, "world"),
                          transformed("toObject", value, space, "object"));
            value = applied("to", value, to, false);
        }
        NetworkNode& result = _network.nodes[index];
        result.id = "ND_dot_vector3";
        result.inputs.clear();
        result.connections = {{"in", value}};
    }

    Connection add(const std::string& name, const std::string& id, Links connections,
                   Values inputs) {
        NetworkNode node;
        node.path = name[0] == '<' ? name : _prefix + name;
        node.id = id;
        node.connections = std::move(connections);
        node.inputs = std::move(inputs);
        const Connection out{node.path, ""};
        if (_known.insert(node.path).second) _network.nodes.push_back(std::move(node));
        return out;
    }

    Connection transformed(const std::string& name, const Connection& in, const std::string& from,
                           const std::string& to) {
        return add(name, "ND_transform" + _kind + "_vector3", {{"in", in}},
                   {{"fromspace", Value::makeString(from)}, {"tospace", Value::makeString(to)}});
    }

    /// The first where the matrix of the space is from the world, the other where it is from the
    /// object.
    Connection mixed(const std::string& name, const std::string& space, const Connection& world,
                     const Connection& object) {
        const Connection local = add(name + "Local", "ND_extract_vector4",
                                     {{"in", rowOf(space, 3)}}, {{"index", Value::makeInt(3)}});
        return add(name + "Side", "ND_mix_vector3", {{"bg", world}, {"fg", object}, {"mix", local}},
                   {});
    }

    Connection rowOf(const std::string& space, int row) {
        Value fallback;
        fallback.type = ValueType::Vec4;
        fallback.numbers = {float(row == 0), float(row == 1), float(row == 2), 0.0f};
        return add(
            spacePrimvar(space, row), "ND_geompropvalue_vector4", {},
            {{"geomprop", Value::makeString(spacePrimvar(space, row))}, {"default", fallback}});
    }

    /// @param back from the space, not into it
    Connection applied(const std::string& name, const Connection& in, const std::string& space,
                       bool back) {
        const bool point = _kind == "point", normal = _kind == "normal";
        const std::string type = point ? "matrix44" : "matrix33";
        Links rows;
        for (int row = 0; row < (point ? 4 : 3); ++row)
            rows["in" + std::to_string(row + 1)] = rowOf(space, row);
        Connection matrix = add(name + "Matrix", "ND_creatematrix_vector3_" + type, rows, {});
        if (back != normal)
            matrix = add(name + "Inverse", "ND_invertmatrix_" + type, {{"in", matrix}}, {});
        if (normal) matrix = add(name + "Transposed", "ND_transpose_" + type, {{"in", matrix}}, {});
        const Connection out = add(
            name + "Applied", point ? "ND_transformmatrix_vector3M4" : "ND_transformmatrix_vector3",
            {{"in", in}, {"mat", matrix}}, {});
        return normal ? add(name + "Unit", "ND_normalize_vector3", {{"in", out}}, {}) : out;
    }

    Network& _network;
    std::set<std::string> _known; ///< paths of nodes
    std::string _kind, _prefix;
};

} // namespace

void resolveNamedSpaces(Network& network) {
    Resolver(network).run();
}

} // namespace patina
