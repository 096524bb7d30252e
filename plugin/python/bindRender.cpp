// SPDX-License-Identifier: Apache-2.0
// The renderer of the Python module. Settings are a dict with the names of RenderSettings' fields.

#include "hdDelegate/renderer/renderer.h"
#include "hdDelegate/backends/backends.h"
#include "hdDelegate/scene/settingRows.h"
#include "plugin/python/filmAtRest.h"
#include "plugin/python/plans.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace py = pybind11;

namespace patina {

namespace {

void set(RenderSettings& settings, const SettingRow& row, py::handle value) {
    std::visit(
        [&](auto member) {
            settings.*member = value.cast<std::decay_t<decltype(settings.*member)>>();
        },
        row.member);
}

py::object get(const RenderSettings& settings, const SettingRow& row) {
    const py::object value =
        std::visit([&](auto member) { return py::cast(settings.*member); }, row.member);
    return std::holds_alternative<PixelWindow RenderSettings::*>(row.member)
               ? py::object(py::tuple(value))
               : value;
}

RenderSettings settingsFrom(const py::dict& dict) {
    RenderSettings settings;
    for (auto item : dict) {
        const std::string name = py::str(item.first);
        const auto& rows = settingRows();
        const auto row = std::find_if(rows.begin(), rows.end(),
                                      [&](const SettingRow& r) { return r.name == name; });
        if (row == rows.end()) throw py::value_error("there is no render setting '" + name + "'");
        try {
            set(settings, *row, item.second);
        } catch (const py::cast_error&) {
            throw py::value_error("render setting '" + name +
                                  "' has a value of the wrong type or size");
        }
    }
    return settings;
}

py::dict defaults() {
    const RenderSettings settings;
    py::dict dict;
    for (const SettingRow& row : settingRows())
        dict[py::str(row.name)] = get(settings, row);
    return dict;
}

void start(Renderer& renderer, std::shared_ptr<Scene> scene, const std::string& camera,
           const py::dict& settings, std::shared_ptr<Film> film) {
    if (!scene || !film) throw py::value_error("a render needs a scene and a film");
    const RenderSettings s = settingsFrom(settings);
    py::gil_scoped_release release;
    renderer.stop(); // of this film, too
    mustRest(*film);
    renderer.start(std::move(scene), camera, s, std::move(film));
}

/// Waits in short steps, so that Ctrl+C and other signals reach Python.
bool wait(Renderer& renderer, double timeout) {
    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    for (int step = 0; renderer.isRunning(); ++step) {
        if (timeout >= 0.0 &&
            std::chrono::duration<double>(Clock::now() - begin).count() >= timeout)
            return false;
        {
            py::gil_scoped_release release;
            // Short renders are not held up by the first steps.
            std::this_thread::sleep_for(std::chrono::milliseconds(step < 20 ? 1 : 10));
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return true;
}

py::dict progress(const Renderer& renderer) {
    const RenderProgress p = renderer.progress();
    py::dict dict;
    dict["fraction"] = p.fraction;
    dict["samplesDone"] = p.samplesDone;
    dict["samplesMean"] = p.samplesMean;
    dict["noise"] = p.noise;
    dict["noiseWanted"] = p.noiseWanted;
    dict["secondsRendering"] = p.secondsRendering;
    dict["secondsLeft"] = p.secondsLeft;
    dict["converged"] = p.converged;
    dict["failed"] = p.failed;
    dict["error"] = p.error;
    dict["deviceFailed"] = p.deviceFailed;
    dict["temporary"] = p.temporary;
    dict["backend"] = p.backend;
    dict["statistics"] = p.statistics;
    dict["materialSeconds"] = p.materialSeconds;
    py::dict plans;
    for (const auto& item : p.plans)
        if (!item.second.choices.empty()) plans[py::str(item.first)] = planDict(item.second);
    dict["plans"] = plans;
    dict["sceneChoices"] = choiceList(p.sceneChoices);
    return dict;
}

std::unique_ptr<Renderer> make(const std::string& backend) {
    std::unique_ptr<Renderer> renderer = makeBackend(backend);
    if (!renderer) throw py::value_error("there is no back end '" + backend + "'");
    return renderer;
}

} // namespace

void bindRender(py::module_& m) {
    py::class_<Renderer>(m, "Renderer", "Renders a scene into a film, in the background.")
        .def("start", &start, py::arg("scene"), py::arg("camera"), py::arg("settings"),
             py::arg("film"),
             "Starts rendering the scene's newest state; ValueError names an unknown setting.")
        .def("stop", &Renderer::stop, py::call_guard<py::gil_scoped_release>(),
             "Returns when no thread works on the film any more.")
        .def("pause", &Renderer::pause, py::call_guard<py::gil_scoped_release>(),
             "Holds the render; the film keeps its samples.")
        .def("resume", &Renderer::resume, py::call_guard<py::gil_scoped_release>(),
             "Goes on after pause().")
        .def_property_readonly("is_running", &Renderer::isRunning,
                               "Whether it renders, or is paused.")
        .def("wait", &wait, py::arg("timeout") = -1.0,
             "Waits for the end, or for so many seconds. Returns whether the render has ended.")
        .def("progress", &progress, "A dict with the fields of RenderProgress.");
    m.def("make_renderer", &make, py::arg("backend") = "embree",
          "A renderer of the back end embree, raster, interactive or auto; ValueError for another "
          "name. Where raster cannot run, the path tracer renders instead, with a warning.");
    m.def("default_render_settings", &defaults, "Every setting with its default.");
}

} // namespace patina
