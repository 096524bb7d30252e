// SPDX-License-Identifier: Apache-2.0
// A material written for other programs: its expanded graph, the definitions of nodes, whole
// shaders.

#include "materialNetwork/material.h"
#include "materialNetwork/nodes/models.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "plugin/python/warningList.h"
#include "shaders/shaderText.h"
#include "shaders/unusedFunctions.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>

namespace py = pybind11;

namespace patina {

namespace {

py::tuple expanded(const Network& network) {
    Diagnostics diagnostics;
    Network result = expandedMaterial(network, diagnostics);
    return py::make_tuple(std::move(result), warningList(diagnostics));
}

template <class Def> py::list typedNames(const std::vector<Def>& defs) {
    py::list list;
    for (const Def& def : defs)
        list.append(py::make_tuple(def.name, valueTypeName(def.type)));
    return list;
}

py::object nodeDefinition(const std::string& id) {
    const NodeDef* def = NodeTable::get().find(id);
    if (!def)
        if (const ShadingModel* model = ModelLibrary::get().find(id)) def = &model->def;
    if (!def) return py::none();
    py::dict dict;
    dict["id"] = def->id;
    dict["category"] = def->category;
    dict["inputs"] = typedNames(def->inputs);
    dict["outputs"] = typedNames(def->outputs);
    return dict;
}

std::vector<std::string> nodeIds() {
    std::vector<std::string> ids;
    for (const auto& def : NodeTable::get().all())
        ids.push_back(def->id);
    for (const auto& model : ModelLibrary::get().all())
        ids.push_back(model->def.id);
    std::sort(ids.begin(), ids.end());
    return ids;
}

std::string wholeShader(const std::string& text) {
    std::string error;
    const ShaderText flat = flattenShader("material", text, error);
    if (!error.empty()) throw py::value_error(error);
    return withoutUnusedFunctions(flat.text);
}

} // namespace

void bindShader(py::module_& m) {
    m.def("expand_material", &expanded, py::arg("network"),
          "The simplified graph of a material as a network of primitive nodes, and the list of "
          "warnings.");
    m.def("node_ids", &nodeIds, "Ids of all node definitions and shading models, sorted.");
    m.def("node_definition", &nodeDefinition, py::arg("id"),
          "The id, category, inputs and outputs (name, MaterialX type) of a node or shading model; "
          "None for an unknown one.");
    m.def("whole_shader", &wholeShader, py::arg("text"),
          "A shader's text with its includes in place, without the functions that it never calls; "
          "ValueError for an include that is not compiled in.");
}

} // namespace patina
