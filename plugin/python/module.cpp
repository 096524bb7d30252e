// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/temporaryFailure.h"
#include "base/utf8.h"

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>
#include <typeinfo>

namespace py = pybind11;

namespace patina {

namespace {

/// Messages quote names in files, which are bytes of any kind; pybind11 takes UTF-8 alone.
void translateRuntimeError(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const std::runtime_error& error) {
        if (typeid(error) != typeid(std::runtime_error)) throw; // pybind11 knows the others
        PyErr_SetString(PyExc_RuntimeError, validUtf8(error.what()).c_str());
    }
}

} // namespace

void bindMachine(py::module_& m);
void bindSignals(py::module_& m);
void bindLimits(py::module_& m);
void bindNetwork(py::module_& m);
void bindScene(py::module_& m);
#ifdef PATINA_BIND_FILM
void bindFilm(py::module_& m);
void bindTemporal(py::module_& m);
void bindLightPaths(py::module_& m);
void bindPartial(py::module_& m);
#endif
#ifdef PATINA_BIND_RENDER
void bindRender(py::module_& m);
#endif
#ifdef PATINA_BIND_MATERIAL
void bindMaterial(py::module_& m);
void bindMaterialProbe(py::module_& m);
void bindMethods(py::module_& m);
void bindShader(py::module_& m);
#endif
#ifdef PATINA_BIND_WEB
void bindWeb(py::module_& m);
void bindWebScene(py::module_& m);
void bindWebLights(py::module_& m);
#endif
#ifdef PATINA_HAS_RASTER
void bindRasterBsdf(py::module_& m);
#endif

} // namespace patina

PYBIND11_MODULE(_patina, m) {
    m.doc() = R"(The compiled part of Patina.

Scene()
    edit() -> SceneEdit         a batch of changes; also a context manager that commits
    version, meters_per_unit
    paths(kind)                 kind is geometry, instancers, lights, cameras or materials
    camera(path) -> dict        apertures, focal_length, orthographic... as set, and image_aspect;
                                KeyError if absent
    material(path) -> Network   as set; KeyError if absent
    dump(values=16) -> str      the scene as text, arrays cut after so many values
    warn(prim, input, id, *fields), warnings() -> list of dicts prim, input, id, message, fields, count
    clear_warnings()

SceneEdit, each prim by path and keywords named like the fields of the C++ structs, in snake case;
an unknown keyword is a TypeError, a value of the wrong shape a ValueError
    set_mesh(path, points=, face_vertex_counts=, face_vertex_indices=, scheme=, ...)
    set_curves(path, points=, curve_vertex_counts=, basis=, wrap=, ...)
    set_points(path, points=, ...)
    set_implicit(path, shape=, axis=, radius=, ...)
    set_splats(path, positions=, orientations=, scales=, opacities=, degree=, harmonics=, ...)
    set_instancer(path, prototypes=, prototype_indices=, transforms=, ...)
    set_light(path, type=, transform=, ...)
    set_camera(path, transform=, ...)
    set_material(path, network)
    set_meters_per_unit(x), set_rendering_color_space(name)
    remove(path), clear(), commit(), warn(prim, input, id, *fields)

Arrays are anything that has the buffer protocol (numpy, pxr.Vt) and are copied once.
Matrices are those of Gf: 16 numbers row by row, the translation last.
transform     a matrix, or (times, matrices)
points        N x 3, or (times, list of N x 3)
transforms    instances x 16, or (times, list of instances x 16)
primvars      list of (name, interpolation, values[, indices]); values N or N x components
subsets       list of (path, material, indices)
visibility    True, False, (camera, indirect, shadow) or (camera, diffuse, shadow, specular,
              transmission, volume)
catching      (matte, shadows, reflections)
marks         dict of the values of primvars that mark_names() has, without 'primvars:'
inputs        of set_camera(): dict of the values of attributes that camera_input_names() has
Times are time codes relative to the frame, ascending.

Network(path)
    add_node(path, id)
    set_input(node, input, type, value, color_space='')
    connect(node, input, source, output='')
    set_terminal(name, node, output='')
    nodes() -> list of dicts, terminals() -> dict

Film, images and colour; Renderer and its settings; materials: see the classes' own help.)";

    py::register_exception_translator(&patina::translateRuntimeError);
#ifdef PATINA_BIND_FILM
    static py::exception<patina::TemporaryFailure> temporary(m, "TemporaryFailure",
                                                             PyExc_RuntimeError);
    py::register_exception_translator([](std::exception_ptr pointer) {
        try {
            if (pointer) std::rethrow_exception(pointer);
        } catch (const patina::TemporaryFailure& error) {
            temporary(patina::validUtf8(error.what()).c_str());
        }
    });
#endif
    patina::bindMachine(m);
    patina::bindSignals(m);
    patina::bindLimits(m);
    patina::bindNetwork(m);
    patina::bindScene(m);
#ifdef PATINA_BIND_FILM
    patina::bindFilm(m);
    patina::bindTemporal(m);
    patina::bindLightPaths(m);
    patina::bindPartial(m);
#endif
#ifdef PATINA_BIND_RENDER
    patina::bindRender(m);
#endif
#ifdef PATINA_BIND_MATERIAL
    patina::bindMaterialProbe(m);
    patina::bindMaterial(m);
    patina::bindMethods(m);
    patina::bindShader(m);
#endif
#ifdef PATINA_BIND_WEB
    patina::bindWeb(m);
    patina::bindWebScene(m);
    patina::bindWebLights(m);
#endif
#ifdef PATINA_HAS_RASTER
    patina::bindRasterBsdf(m);
#endif
}
