// SPDX-License-Identifier: Apache-2.0
// Materials of the Python module as networks: explanations, overrides, translations, nodes,
// MaterialX documents.

#include "plugin/python/warningList.h"

#include "materialNetwork/material.h"
#include "materialNetwork/mtlx/document.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/network/translate.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

namespace py = pybind11;

namespace patina {

namespace {

void appendWarnings(const Diagnostics& diagnostics, py::object& list) {
    if (!list.is_none()) list.attr("extend")(warningList(diagnostics));
}

py::dict nodeInputs(const std::string& id) {
    const NodeDef* def = NodeTable::get().find(id);
    if (!def)
        if (const ShadingModel* model = ModelLibrary::get().find(id)) def = &model->def;
    py::dict dict;
    if (def)
        for (const InputDef& input : def->inputs)
            dict[py::str(input.name)] = valueTypeName(input.type);
    return dict;
}

py::dict nodeDefaults(const std::string& id) {
    const NodeDef* def = NodeTable::get().find(id);
    if (!def)
        if (const ShadingModel* model = ModelLibrary::get().find(id)) def = &model->def;
    py::dict dict;
    if (def)
        for (const InputDef& input : def->inputs)
            if (input.geomprop.empty() && !isClosureType(input.type)) {
                if (valueTypeComponents(input.type) == 0)
                    dict[py::str(input.name)] = input.value.text;
                else
                    dict[py::str(input.name)] = input.value.numbers;
            }
    return dict;
}

std::map<std::string, std::vector<std::string>> nodeWords(const std::string& id) {
    std::map<std::string, std::vector<std::string>> words;
    if (const NodeDef* def = NodeTable::get().find(id))
        for (const InputDef& input : def->inputs)
            if (!input.words.empty()) words[input.name] = input.words;
    return words;
}

Network overridden(const Network& network, const std::map<std::string, std::string>& texts) {
    MaterialOverrides overrides;
    for (const auto& [target, text] : texts) {
        Value value;
        if (!parseOverride(network, target, text, value))
            throw py::value_error(network.path + " has no input " + target + " that can be '" +
                                  text + "'");
        overrides[target] = value;
    }
    Diagnostics diagnostics;
    Network result = applyOverrides(network, overrides, diagnostics);
    for (const Diagnostic& d : diagnostics.all())
        throw py::value_error(d.prim + (d.input.empty() ? "" : "." + d.input) + ": " + d.message);
    return result;
}

py::list points() {
    py::list list;
    for (const ChoicePoint& point : choicePoints()) {
        py::list methods;
        for (const Method& method : point.methods)
            methods.append(py::make_tuple(method.name, method.description));
        list.append(py::make_tuple(point.name, methods));
    }
    return list;
}

} // namespace

void bindMaterial(py::module_& m) {
    m.def(
        "explain_material",
        [](const Network& network, py::object warnings, const MethodChoices& methods) {
            Diagnostics diagnostics;
            std::string text = explainMaterial(network, diagnostics, methods);
            appendWarnings(diagnostics, warnings);
            return text;
        },
        py::arg("network"), py::arg("warnings") = py::none(), py::arg("methods") = MethodChoices(),
        "The model of a material, as text. Warnings are appended to the list.");
    m.def("override_material", &overridden, py::arg("network"), py::arg("inputs"),
          "The network with inputs replaced, given as text; ValueError names what cannot be.");
    m.def("check_methods", &checkMethods, py::arg("methods"),
          "Empty, or a sentence that names the choice point or method that does not exist.");
    m.def("choice_points", &points,
          "List of (choice point, list of (method, description)); the first is the default.");
    m.def("display_color_network", &makeDisplayColorNetwork, "The material of prims without one.");
    m.def("node_inputs", &nodeInputs, py::arg("id"),
          "Names and MaterialX types of a node's inputs; empty for an unknown node.");
    m.def(
        "translate_material",
        [](const Network& network, const std::string& target, py::object warnings) {
            Diagnostics diagnostics;
            Network result = translateMaterial(network, target, diagnostics);
            appendWarnings(diagnostics, warnings);
            return result;
        },
        py::arg("network"), py::arg("target"), py::arg("warnings") = py::none(),
        "The material as another shading model; a network without terminals where it cannot be.");
    m.def(
        "model_warnings", [] { return warningList(ModelLibrary::get().diagnostics()); },
        "Errors in the models of the library, those of PATINA_MODEL_PATH among them.");
    m.def("translatable_models", &translatableModels);
    m.def("node_defaults", &nodeDefaults, py::arg("id"),
          "Default values of a node's inputs; those that come from the geometry are left out.");
    m.def("node_words", &nodeWords, py::arg("id"),
          "The values that strings of a node may have, where that is a list.");
    m.def(
        "read_mtlx",
        [](const std::string& path, py::object warnings, double metersPerUnit) {
            Diagnostics diagnostics;
            std::vector<Network> networks;
            {
                py::gil_scoped_release release;
                networks = readMtlx(path, diagnostics, metersPerUnit);
            }
            appendWarnings(diagnostics, warnings);
            return networks;
        },
        py::arg("path"), py::arg("warnings") = py::none(), py::arg("meters_per_unit") = 1.0,
        "The materials of a MaterialX document. Warnings are appended to the list. Distances that "
        "have a unit become units of a scene with so many metres in each.");
    m.def(
        "mtlx_files",
        [](const std::string& path) {
            std::vector<py::bytes> files;
            for (const std::string& file : documentFiles(path))
                files.emplace_back(file);
            return files;
        },
        py::arg("path"),
        "The files that read_mtlx looks at, as bytes: a document and all that it includes.");
    m.def(
        "unit_factor",
        [](const std::string& unit, const std::string& id, const std::string& input,
           double metersPerUnit) -> py::object {
            const Unit known = unitOf(unit);
            if (known.kind == Unit::Kind::Unknown) return py::none();
            return py::float_(unitFactor(known, id, input, metersPerUnit));
        },
        py::arg("unit"), py::arg("id"), py::arg("input"), py::arg("meters_per_unit"),
        "What a number in a unit of MaterialX is multiplied by where it is the input of a node "
        "with that definition; None for an unknown unit.");
}

} // namespace patina
