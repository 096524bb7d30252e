// Lights and meshes of a scene, as the material page takes them.

#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/tessellate.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace py = pybind11;

namespace patina {

namespace {

constexpr float degree = 3.14159265358979f / 180.0f;

std::array<float, 3> triple(const vec3& v) {
    return {v.x, v.y, v.z};
}

/// The eight texels of shaders/web/lights.glsl; empty for a light that gives none.
std::vector<float> lightRow(const Light& light, const mat4& toWorld) {
    enum { Rect, Disk, Sphere, Cylinder, Point, Distant };
    vec4 row[8] = {};
    const float axisLength = glm::length(vec3(toWorld[2]));
    const vec3 z = axisLength > 0.0f ? vec3(toWorld[2]) / axisLength : vec3(0.0f, 0.0f, 1.0f);
    vec3 radiance = glm::max(lightRadiance(light, toWorld), vec3(0.0f));
    int kind = Distant;
    row[4] = vec4(-z, 1.0f);
    if (light.type == LightType::Distant) {
        row[4].w = std::cos(0.5f * degree * std::clamp(light.angle, 0.0f, 360.0f));
        // Floats cannot tell the cosines of narrow cones apart: those shine from one direction.
        if (row[4].w > 0.999999f && light.angle > 0.0f) {
            radiance *= float(lightSizeFactor(light, toWorld));
            row[4].w = 1.0f;
        }
    } else if (light.type == LightType::Sphere && light.treatAsPoint) {
        kind = Point;
        radiance = lightBaseRadiance(light) * 0.25f *
                   (light.normalize ? 1.0f : float(lightSizeFactor(light, toWorld)));
    } else {
        const AreaShape shape = makeAreaShape(light, toWorld);
        if (!shape.valid) return {};
        const float half = shape.kind == AreaShape::Kind::Disk ? 1.0f : 0.5f;
        kind = shape.kind == AreaShape::Kind::Rect     ? Rect
               : shape.kind == AreaShape::Kind::Disk   ? Disk
               : shape.kind == AreaShape::Kind::Sphere ? Sphere
                                                       : Cylinder;
        const float across =
            kind == Sphere ? std::cbrt(std::abs(shape.determinant)) : glm::length(shape.axes[1]);
        row[2] = vec4(shape.axes[0] * half, across);
        row[3] = vec4(shape.axes[1] * half, shape.area);
        if (kind == Rect || kind == Disk) row[4] = vec4(shape.normal, 0.0f);
        row[0] = vec4(shape.origin, 0.0f);
    }
    if (kind == Point) row[0] = vec4(vec3(toWorld[3]), 0.0f);
    row[0].w = float(kind);
    row[1] = vec4(radiance, 1.0f);
    const float cone = light.shapingConeAuthored ? light.shapingConeAngle * degree : 0.0f;
    row[5] = vec4(std::max(light.shapingFocus, 0.0f), std::max(cone, 0.0f),
                  cone * (1.0f - std::clamp(light.shapingConeSoftness, 0.0f, 1.0f)), 0.0f);
    row[6] = vec4(light.shapingFocusTint, 0.0f);
    row[7] = vec4(light.diffuse, light.specular, 0.0f, 0.0f);
    std::vector<float> out;
    for (const vec4& texel : row)
        for (int c = 0; c < 4; ++c) {
            if (!std::isfinite(texel[c])) return {};
            out.push_back(texel[c]);
        }
    return out;
}

py::dict lightsOf(const Scene& scene) {
    py::list direct, domes;
    for (const auto& [path, light] : scene.snapshot()->lights) {
        if (!light->visible || !light->group.empty()) continue;
        const mat4 toWorld = transformAt(light->transform, 0.0f);
        if (light->type == LightType::Dome) {
            py::dict dome;
            dome["path"] = path;
            dome["texture"] = light->textureFile;
            dome["radiance"] = triple(glm::max(lightRadiance(*light, toWorld), vec3(0.0f)));
            dome["axes"] = std::vector<std::array<float, 3>>{
                triple(vec3(toWorld[0])), triple(vec3(toWorld[1])), triple(vec3(toWorld[2]))};
            domes.append(dome);
        } else if (light->type != LightType::Mesh) {
            const std::vector<float> row = lightRow(*light, toWorld);
            if (!row.empty()) direct.append(py::make_tuple(path, row));
        }
    }
    py::dict dict;
    dict["lights"] = direct;
    dict["domes"] = domes;
    return dict;
}

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
    m.def("web_lights", &lightsOf, py::arg("scene"),
          "lights: (path, 32 floats in the layout of shaders/web/lights.glsl); domes: dicts of "
          "path, texture, radiance and axes. Light groups and mesh lights are left out.");
    m.def("web_mesh", &meshOf, py::arg("scene"), py::arg("path"),
          "Triangles of a prim as arrays with three rows each: points, normals, uv, colors; "
          "toWorld as 16 columns. KeyError, or ValueError for a prim without triangles.");
    m.def("web_shapes", &shapesOf, py::arg("scene"),
          "(path, material) of the prims that web_mesh() takes.");
}

} // namespace patina
