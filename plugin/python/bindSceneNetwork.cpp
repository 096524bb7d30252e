// SPDX-License-Identifier: Apache-2.0
// Material networks.

#include "materialNetwork/network/translate.h"
#include "plugin/python/fields.h"
#include "plugin/python/warningList.h"

namespace py = pybind11;

namespace patina {

namespace {

Value valueFrom(const std::string& type, py::handle from, const std::string& colorSpace) {
    Value value;
    value.type = valueTypeFromName(type);
    value.colorSpace = colorSpace;
    const int components = valueTypeComponents(value.type);
    if (components == 0) {
        value.text = py::str(from);
        return value;
    }
    if (py::isinstance<py::bool_>(from))
        value.numbers = {from.cast<bool>() ? 1.0f : 0.0f};
    else if (py::isinstance<py::float_>(from) || py::isinstance<py::int_>(from))
        value.numbers = {from.cast<float>()};
    else {
        const auto array =
            py::array_t<float, py::array::c_style | py::array::forcecast>::ensure(from);
        if (!array) {
            PyErr_Clear();
            throw py::value_error("is not a number or an array of them");
        }
        value.numbers.assign(array.data(), array.data() + array.size());
    }
    if (int(value.numbers.size()) != components)
        throw py::value_error("needs " + std::to_string(components) + " numbers for type '" + type +
                              "', not " + std::to_string(value.numbers.size()));
    return value;
}

NetworkNode& nodeOf(Network& network, const std::string& path) {
    if (const NetworkNode* node = network.find(path)) return const_cast<NetworkNode&>(*node);
    throw py::key_error("the network has no node " + path);
}

void addNode(Network& network, const std::string& path, const std::string& id) {
    NetworkNode node;
    node.path = path;
    node.id = id;
    if (!network.add(std::move(node)))
        throw py::value_error("the network already has a node " + path);
}

py::object numbersOf(const Value& value) {
    if (valueTypeComponents(value.type) == 0) return py::str(value.text);
    if (value.numbers.size() == 1) return py::float_(value.numbers[0]);
    return py::cast(value.numbers);
}

py::list nodes(const Network& network) {
    py::list list;
    for (const NetworkNode& node : network.nodes) {
        py::dict item, inputs, connections;
        for (const auto& [name, value] : node.inputs) {
            py::dict input;
            input["type"] = valueTypeName(value.type);
            input["value"] = numbersOf(value);
            input["color_space"] = value.colorSpace;
            inputs[py::str(name)] = input;
        }
        for (const auto& [name, connection] : node.connections)
            connections[py::str(name)] = py::make_tuple(connection.node, connection.output);
        item["path"] = node.path;
        item["id"] = node.id;
        item["inputs"] = inputs;
        item["connections"] = connections;
        list.append(item);
    }
    return list;
}

} // namespace

void bindNetwork(py::module_& m) {
    py::class_<Network>(m, "Network", "A material as authored.")
        .def(py::init([](const std::string& path) {
                 Network network;
                 network.path = path;
                 return network;
             }),
             py::arg("path"))
        .def_readonly("path", &Network::path, "The material's own path.")
        .def(
            "add_node", &addNode, py::arg("path"), py::arg("id"),
            "A node by its definition's name, such as ND_conductor_bsdf. ValueError where the path "
            "is taken; a definition that is not known is warned of when the material is compiled.")
        .def(
            "set_input",
            [](Network& network, const std::string& node, const std::string& input,
               const std::string& type, py::object value, const std::string& colorSpace) {
                nodeOf(network, node).inputs[input] = valueFrom(type, value, colorSpace);
            },
            py::arg("node"), py::arg("input"), py::arg("type"), py::arg("value"),
            py::arg("color_space") = "",
            "ValueError when the value does not fit the type. Types are MaterialX's or Sdf's.")
        .def(
            "connect",
            [](Network& network, const std::string& node, const std::string& input,
               const std::string& source, const std::string& output) {
                nodeOf(network, node).connections[input] = Connection{source, output};
            },
            py::arg("node"), py::arg("input"), py::arg("source"), py::arg("output") = "",
            "Connects a node's input to an output of another node; empty: its only one. KeyError "
            "where the node was not added.")
        .def(
            "set_terminal",
            [](Network& network, const std::string& name, const std::string& node,
               const std::string& output) {
                network.terminals[name] = Connection{node, output};
            },
            py::arg("name"), py::arg("node"), py::arg("output") = "",
            "Names the node that is the material's surface, displacement or volume.")
        .def(
            "upgrade",
            [](Network& network) {
                Diagnostics diagnostics;
                upgradeNetwork(network, diagnostics);
                return warningList(diagnostics);
            },
            "Makes a network of MaterialX 1.38 one of 1.39, whose nodes differ. Returns warnings, "
            "dicts as Scene.warnings() gives them.")
        .def_property_readonly("empty", &Network::empty, "Whether it has no node.")
        .def("nodes", &nodes, "Dicts of path, id, inputs and connections.")
        .def(
            "terminals",
            [](const Network& network) {
                py::dict dict;
                for (const auto& [name, connection] : network.terminals)
                    dict[py::str(name)] = py::make_tuple(connection.node, connection.output);
                return dict;
            },
            "Name -> (node, output).");
}

} // namespace patina
