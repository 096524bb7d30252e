// SPDX-License-Identifier: Apache-2.0
// Meshes of a scene, as the material page takes them.

#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/scene.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <functional>

namespace py = pybind11;

namespace patina {

namespace {

using Floats = py::array_t<float>;

Floats corners(const TriangleMesh& mesh, int components,
               const std::function<const float*(size_t triangle, int corner)>& at) {
    Floats out(std::vector<size_t>{3 * mesh.triangles.size(), size_t(components)});
    float* to = out.mutable_data();
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        for (int c = 0; c < 3; ++c) {
            const float* from = at(t, c);
            to = std::copy(from, from + components, to);
        }
    return out;
}

const float* valueAt(const TriangleMesh& mesh, const MeshAttribute& a, size_t t, int c) {
    size_t i = 0;
    switch (a.rate) {
    case MeshAttribute::Rate::Constant: break;
    case MeshAttribute::Rate::PerFace: i = size_t(mesh.triangleFace[t]); break;
    case MeshAttribute::Rate::PerVertex: i = mesh.triangles[t][c]; break;
    case MeshAttribute::Rate::PerCorner: i = 3 * t + size_t(c); break;
    case MeshAttribute::Rate::PerControl: break; // of curves
    }
    return a.data.data() + i * size_t(a.components);
}

py::dict meshOf(const Scene& scene, const std::string& path) {
    const auto state = scene.snapshot();
    const auto found = state->geometry.find(path);
    if (found == state->geometry.end()) throw py::key_error("there is no prim " + path);
    const Geometry& prim = *found->second;
    Diagnostics diagnostics;
    TessellationOptions options;
    options.triangleBudget = 100000;
    TriangleMesh mesh;
    if (prim.kind == GeometryKind::Mesh)
        mesh = tessellate(static_cast<const Mesh&>(prim), options, diagnostics);
    else if (prim.kind == GeometryKind::Implicit)
        mesh = tessellate(static_cast<const Implicit&>(prim), options, diagnostics);
    if (mesh.triangles.empty()) throw py::value_error(path + " has no triangles");
    const auto position = [&](size_t t, int c) {
        return &mesh.positions[0][mesh.triangles[t][c]].x;
    };
    py::dict dict;
    dict["points"] = corners(mesh, 3, position);
    if (!mesh.normals.empty()) {
        const bool perVertex = mesh.normalRate == MeshAttribute::Rate::PerVertex;
        const bool perFace = mesh.normalRate == MeshAttribute::Rate::PerFace;
        dict["normals"] = corners(mesh, 3, [&](size_t t, int c) {
            const size_t i = perVertex ? mesh.triangles[t][c]
                             : perFace ? size_t(mesh.triangleFace[t])
                                       : 3 * t + size_t(c);
            return &mesh.normals[0][i].x;
        });
    }
    for (const MeshAttribute& a : mesh.attributes) {
        const auto value = [&](size_t t, int c) { return valueAt(mesh, a, t, c); };
        if (a.components == 2 && (a.name == "st" || !dict.contains("uv")))
            dict["uv"] = corners(mesh, 2, value);
        if (a.components == 3 && a.name == "displayColor") dict["colors"] = corners(mesh, 3, value);
    }
    const mat4 toWorld = transformAt(prim.transform, 0.0f);
    std::vector<float> columns;
    for (int i = 0; i < 16; ++i)
        columns.push_back(toWorld[i / 4][i % 4]);
    dict["toWorld"] = columns;
    dict["material"] = prim.material;
    return dict;
}

py::list shapesOf(const Scene& scene) {
    py::list list;
    for (const auto& [path, prim] : scene.snapshot()->geometry)
        if (prim->group.empty() &&
            (prim->kind == GeometryKind::Mesh || prim->kind == GeometryKind::Implicit))
            list.append(py::make_tuple(path, prim->material));
    return list;
}

} // namespace

void bindWebScene(py::module_& m) {
    m.def("web_mesh", &meshOf, py::arg("scene"), py::arg("path"),
          "Triangles of a prim as arrays with three rows each: points, normals, uv, colors; "
          "toWorld as 16 columns. KeyError, or ValueError for a prim without triangles.");
    m.def("web_shapes", &shapesOf, py::arg("scene"),
          "(path, material) of the prims that web_mesh() takes.");
}

} // namespace patina
