// SPDX-License-Identifier: Apache-2.0
// The scene, its edits, lights and cameras.

#include "plugin/python/sceneEdit.h"
#include "hdDelegate/scene/cameraInputs.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/sceneDump.h"
#include "materialNetwork/material.h"
#include "plugin/python/fields.h"
#include "plugin/python/warningList.h"

namespace py = pybind11;

namespace patina {

void bindSceneGeometry(py::class_<PythonEdit>& edit);

namespace {

std::shared_ptr<Light> lightOf(const std::string& path, const py::kwargs& values) {
    auto light = std::make_shared<Light>();
    light->path = path;
    Fields("set_light", path, values)
        .read("group", light->group)
        .read("type", light->type)
        .read("transform", light->transform)
        .read("visible", light->visible)
        .read("camera_visible", light->cameraVisible)
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    .read(key, light->field)
#include "hdDelegate/scene/lightTypes.inc"
        .read("texture_color_space", light->textureColorSpace)
        .read("shaping_cone_authored", light->shapingConeAuthored)
        .read("light_link", light->lightLink)
        .read("shadow_link", light->shadowLink)
        .read("filters", light->filters)
        .read("network", light->network)
        .read("portals", light->portals)
        .read("light_group", light->lightGroup)
        .read("geometry", light->geometry)
        .read("material_sync_mode", light->materialSyncMode)
        .finish();
    return light;
}

void setLight(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    edit.set(std::shared_ptr<const Light>(lightOf(path, values)));
}

void setCamera(PythonEdit& edit, const std::string& path, const py::kwargs& values) {
    auto camera = std::make_shared<Camera>();
    Marks inputs;
    camera->path = path;
    Fields("set_camera", path, values)
        .read("transform", camera->transform)
        .read("orthographic", camera->orthographic)
#define PATINA_CAMERA_INPUT(field, key, Getter, unit, positive, fallback, description)             \
    .read(key, camera->field)
#include "hdDelegate/scene/cameraTypes.inc"
        .read("clip_near", camera->clipNear)
        .read("clip_far", camera->clipFar)
        .read("clipping_planes", camera->clippingPlanes)
        .read("shutter_open", camera->shutterOpen)
        .read("shutter_close", camera->shutterClose)
        .read("exposure_scale", camera->exposureScale)
        .read("inputs", inputs)
        .finish();
    applyCameraInputs(inputs, *camera, edit.scene->diagnostics());
    edit.set(std::shared_ptr<const Camera>(std::move(camera)));
}

void setMaterial(PythonEdit& edit, const std::string& path, const Network& network) {
    auto material = std::make_shared<MaterialPrim>();
    material->path = path;
    material->network = network;
    edit.set(std::shared_ptr<const MaterialPrim>(std::move(material)));
}

template <class T> const T& find(const PrimMap<T>& prims, const std::string& path) {
    const auto found = prims.find(path);
    if (found == prims.end()) throw py::key_error(path);
    return *found->second;
}

py::dict cameraDict(const Scene& scene, const std::string& path) {
    const auto state = scene.snapshot();
    const Camera& camera = find(state->cameras, path);
    py::dict dict;
    dict["path"] = camera.path;
    dict["orthographic"] = camera.orthographic;
#define PATINA_CAMERA_INPUT(field, key, Getter, unit, positive, fallback, description)             \
    dict[key] = camera.field;
#include "hdDelegate/scene/cameraTypes.inc"
    dict["shutter_open"] = camera.shutterOpen;
    dict["shutter_close"] = camera.shutterClose;
    dict["exposure_scale"] = camera.exposureScale;
    dict["image_aspect"] = imageAspect(camera);
    dict["has_overscan"] = camera.lens.hasOverscan();
    return dict;
}

template <class T> std::vector<std::string> keys(const PrimMap<T>& prims) {
    std::vector<std::string> paths;
    for (const auto& item : prims)
        paths.push_back(item.first);
    return paths;
}

std::vector<std::string> paths(const Scene& scene, const std::string& kind) {
    const auto state = scene.snapshot();
    if (kind == "geometry") return keys(state->geometry);
    if (kind == "instancers") return keys(state->instancers);
    if (kind == "lights") return keys(state->lights);
    if (kind == "cameras") return keys(state->cameras);
    if (kind == "materials") return keys(state->materials);
    throw py::value_error("there is no kind of prim '" + kind + "'");
}

template <class Rows> py::dict wordsBySchemas(const Rows& rows) {
    py::dict words;
    for (const auto& row : rows)
        words[row.schemas] = row.word;
    return words;
}

} // namespace

void bindScene(py::module_& m) {
    py::class_<PythonEdit> edit(m, "SceneEdit", "A batch of changes to a scene.");
    bindSceneGeometry(edit);
    m.def("mark_names", &markNames,
          "Primvars, without 'primvars:', that say which rays see a prim and what mattes make of "
          "it.");
    m.def(
        "camera_input_names", &cameraInputNames,
        "Attributes of cameras beyond UsdGeomCamera's own; each may stand after 'primvars:' too.");
    m.def(
        "light_types", [] { return wordsBySchemas(lightRows); },
        "UsdLux types, separated by blanks where several are read alike -> word for set_light().");
    m.def(
        "light_inputs",
        [] {
            py::list inputs;
#define PATINA_LIGHT_INPUT(group, type, field, key, input, fallback, description)                  \
    inputs.append(py::make_tuple(#group, input, key, #type));
#include "hdDelegate/scene/lightTypes.inc"
            return inputs;
        },
        "Inputs of lights: (Light, Shape, Shaping, Shadow or Image, name in the schema, keyword of "
        "set_light(), float, bool, vec3 or std::string).");
    m.def(
        "camera_inputs",
        [] {
            py::list inputs;
#define PATINA_CAMERA_INPUT(field, key, Getter, unit, positive, fallback, description)             \
    inputs.append(py::make_tuple(#field, key, fallback));
#include "hdDelegate/scene/cameraTypes.inc"
            return inputs;
        },
        "Numbers of UsdGeomCamera: (attribute, keyword of set_camera(), fallback).");
    m.def(
        "light_radiance",
        [](const py::kwargs& values) {
            const vec3 radiance = lightBaseRadiance(*lightOf("", values));
            return std::array<float, 3>{radiance.x, radiance.y, radiance.z};
        },
        "intensity 2^exposure color of a light, by the keywords of set_light().");
    m.def(
        "space_primvar", &spacePrimvar, py::arg("space"), py::arg("row"),
        "The primvar of a row of the matrix into a coordinate system that is bound to a prim. The "
        "fourth number of row 3 says from where: 0 the world, 1 the object.");
    m.attr("STAND_IN_WIDTH") = standInWidth;
    m.def(
        "light_filter_types", [] { return wordsBySchemas(lightFilterRows); },
        "Types of light filters, separated by blanks where several are read alike -> word.");
    m.def(
        "light_filter_inputs",
        [] {
            py::list inputs;
#define PATINA_FILTER_INPUT(type, field, names, fallback, description)                             \
    inputs.append(py::make_tuple(names, #field, #type));
#include "hdDelegate/scene/lightFilterInputs.inc"
            return inputs;
        },
        "Inputs of light filters: (names in schemas, separated by blanks, key of a filter of "
        "set_light(), type).");
    m.def(
        "ignored_light_filter_inputs",
        [] {
            py::dict ignored;
            for (const IgnoredFilterInput& row : ignoredFilterInputs)
                ignored[row.names] = row.idle;
            return ignored;
        },
        "Inputs of light filters that are not evaluated -> the values, separated by blanks, at "
        "which they do nothing.");
    edit.def("set_light", &setLight, py::arg("path"),
             "A UsdLux light; keywords are the fields of Light. filters: a list of dicts of path, "
             "type, transform and light_filter_inputs(). portals: of path, "
             "transform, width and height. network: of what inputs are connected to, a terminal "
             "by each input's name.")
        .def(
            "set_camera", &setCamera, py::arg("path"),
            "A UsdGeomCamera; keywords are the fields of Camera. inputs: a dictionary of values by "
            "camera_input_names().")
        .def("set_material", &setMaterial, py::arg("path"), py::arg("network"),
             "A material; prims name it by its path.")
        .def("set_meters_per_unit", &PythonEdit::setMetersPerUnit, py::arg("meters_per_unit"),
             "Length of a scene unit in metres, above 0.")
        .def(
            "set_rendering_color_space",
            [](PythonEdit& edit, const std::string& name) {
                const RenderingSpace* space = RenderingSpace::find(name);
                if (!space) throw py::value_error("there is no linear colour space '" + name + "'");
                edit.setRenderingSpace(*space);
            },
            py::arg("name"),
            "The linear space in which colours of lights and primvars are given, '' for Rec.709. "
            "Give them anew after it has changed.")
        .def(
            "remove", [](PythonEdit& edit, const std::string& path) { edit.remove(path); },
            py::arg("path"), "Removes the prim with that path, of whatever kind, if there is one.")
        .def("clear", &PythonEdit::clear, "Removes everything that was there before.")
        .def("commit", &PythonEdit::commit, py::call_guard<py::gil_scoped_release>(),
             "Makes the changes the scene's newest state, all at once; a `with` block does so.")
        .def(
            "warn",
            [](PythonEdit& edit, const std::string& prim, const std::string& input,
               const std::string& id, const py::args& fields) {
                edit.scene->diagnostics().warn(prim, input, messageOf(id, fields));
            },
            py::arg("prim"), py::arg("input"), py::arg("id"),
            "Adds a warning to the scene's: a message of base/messages.def with its fields, in the "
            "order of its row.")
        .def("__enter__", [](py::object self) { return self; })
        .def("__exit__", [](PythonEdit& self, const py::args&) { self.commit(); });

    py::class_<Scene, std::shared_ptr<Scene>>(m, "Scene", "The renderer's own scene.")
        .def(py::init<>())
        .def(
            "edit",
            [](std::shared_ptr<Scene> s) {
                if (!s) throw py::type_error("there is no scene to edit");
                return std::make_unique<PythonEdit>(std::move(s));
            },
            "A new batch of changes, which commits at the end of a `with` block.")
        .def_property_readonly(
            "version", [](const Scene& s) { return s.snapshot()->version; },
            "Grows by one with every commit.")
        .def_property_readonly(
            "meters_per_unit", [](const Scene& s) { return s.snapshot()->metersPerUnit; },
            "Length of a scene unit in metres.")
        .def("paths", &paths, py::arg("kind"),
             "Paths of all geometry, instancers, lights, cameras or materials; ValueError for "
             "another kind.")
        .def("camera", &cameraDict, py::arg("path"),
             "A camera's values by set_camera()'s keywords, has_overscan, and image_aspect, the "
             "width over the height that its image has of itself; KeyError where there is none.")
        .def(
            "material",
            [](const Scene& s, const std::string& path) {
                return find(s.snapshot()->materials, path).network;
            },
            py::arg("path"), "A material as it was set; KeyError where there is none.")
        .def(
            "dump", [](const Scene& s, int values) { return dumpScene(*s.snapshot(), values); },
            py::arg("values") = 16, "The scene as text; arrays are cut after so many values.")
        .def(
            "warn",
            [](Scene& s, const std::string& prim, const std::string& input, const std::string& id,
               const py::args& fields) {
                s.diagnostics().warn(prim, input, messageOf(id, fields));
            },
            py::arg("prim"), py::arg("input"), py::arg("id"),
            "Adds a warning, as SceneEdit.warn(); one that is there already is counted.")
        .def(
            "warnings", [](Scene& s) { return warningList(s.diagnostics()); },
            "Problems of the scene: dicts of prim, input, id, message, fields of the message by "
            "name, and count, how often it was met.")
        .def(
            "clear_warnings", [](Scene& s) { s.diagnostics().clear(); }, "Forgets all warnings.");
}

} // namespace patina
