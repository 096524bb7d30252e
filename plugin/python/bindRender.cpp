// The renderer of the Python module. Settings are a dict with the names of RenderSettings' fields.

#include "hdDelegate/renderer/renderer.h"
#include "hdDelegate/backends/backends.h"
#include "plugin/python/plans.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <thread>

namespace py = pybind11;

namespace patina {

namespace {

struct Field {
    std::function<void(RenderSettings&, py::handle)> set;
    std::function<py::object(const RenderSettings&)> get;
};

template <class T> Field field(T RenderSettings::*member) {
    return {[member](RenderSettings& s, py::handle v) { s.*member = v.cast<T>(); },
            [member](const RenderSettings& s) { return py::cast(s.*member); }};
}

const std::map<std::string, Field>& fields() {
    static const std::map<std::string, Field> all = {
        {"width", field(&RenderSettings::width)},
        {"height", field(&RenderSettings::height)},
        {"dataWindow",
         {[](RenderSettings& s, py::handle v) {
              auto window = v.cast<std::array<int, 4>>();
              std::copy(window.begin(), window.end(), s.dataWindow);
          },
          [](const RenderSettings& s) {
              const int* w = s.dataWindow;
              return py::object(py::make_tuple(w[0], w[1], w[2], w[3]));
          }}},
        {"pixelAspectRatio", field(&RenderSettings::pixelAspectRatio)},
        {"aspectRatioConformPolicy", field(&RenderSettings::aspectRatioConformPolicy)},
        {"samples", field(&RenderSettings::samples)},
        {"minSamples", field(&RenderSettings::minSamples)},
        {"tolerance", field(&RenderSettings::tolerance)},
        {"seconds", field(&RenderSettings::seconds)},
        {"threads", field(&RenderSettings::threads)},
        {"seed", field(&RenderSettings::seed)},
        {"maxDepth", field(&RenderSettings::maxDepth)},
        {"maxScatterings", field(&RenderSettings::maxScatterings)},
        {"lightSamples", field(&RenderSettings::lightSamples)},
        {"rouletteDepth", field(&RenderSettings::rouletteDepth)},
        {"indirectClamp", field(&RenderSettings::indirectClamp)},
        {"filterRadius", field(&RenderSettings::filterRadius)},
        {"enableSceneLights", field(&RenderSettings::enableSceneLights)},
        {"enableSceneMaterials", field(&RenderSettings::enableSceneMaterials)},
        {"enableShadows", field(&RenderSettings::enableShadows)},
        {"enableMotionBlur", field(&RenderSettings::enableMotionBlur)},
        {"enableDepthOfField", field(&RenderSettings::enableDepthOfField)},
        {"domeLightCameraVisibility", field(&RenderSettings::domeLightCameraVisibility)},
        {"cullStyle", field(&RenderSettings::cullStyle)},
        {"edgeLength", field(&RenderSettings::edgeLength)},
        {"interactive", field(&RenderSettings::interactive)},
        {"renderTags", field(&RenderSettings::renderTags)},
        {"rootPaths", field(&RenderSettings::rootPaths)},
        {"excludePaths", field(&RenderSettings::excludePaths)},
        {"integrator", field(&RenderSettings::integrator)},
        {"ambientOcclusionSamples", field(&RenderSettings::ambientOcclusionSamples)},
        {"environmentSamples", field(&RenderSettings::environmentSamples)},
        {"aovs", field(&RenderSettings::aovs)},
        {"checkpointFile", field(&RenderSettings::checkpointFile)},
        {"checkpointSeconds", field(&RenderSettings::checkpointSeconds)},
        {"methods", field(&RenderSettings::methods)},
    };
    return all;
}

RenderSettings settingsFrom(const py::dict& dict) {
    RenderSettings settings;
    for (auto item : dict) {
        const std::string name = py::str(item.first);
        const auto field = fields().find(name);
        if (field == fields().end())
            throw py::value_error("there is no render setting '" + name + "'");
        try {
            field->second.set(settings, item.second);
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
    for (const auto& [name, field] : fields())
        dict[py::str(name)] = field.get(settings);
    return dict;
}

void start(Renderer& renderer, std::shared_ptr<Scene> scene, const std::string& camera,
           const py::dict& settings, std::shared_ptr<Film> film) {
    if (!scene || !film) throw py::value_error("a render needs a scene and a film");
    const RenderSettings s = settingsFrom(settings);
    py::gil_scoped_release release;
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
    dict["secondsRendering"] = p.secondsRendering;
    dict["secondsLeft"] = p.secondsLeft;
    dict["converged"] = p.converged;
    dict["failed"] = p.failed;
    dict["error"] = p.error;
    dict["deviceFailed"] = p.deviceFailed;
    dict["backend"] = p.backend;
    dict["statistics"] = p.statistics;
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
        .def("pause", &Renderer::pause, py::call_guard<py::gil_scoped_release>())
        .def("resume", &Renderer::resume, py::call_guard<py::gil_scoped_release>())
        .def_property_readonly("is_running", &Renderer::isRunning)
        .def("wait", &wait, py::arg("timeout") = -1.0,
             "Waits for the end, or for so many seconds. Returns whether the render has ended.")
        .def("progress", &progress, "A dict with the fields of RenderProgress.");
    m.def("make_renderer", &make, py::arg("backend") = "embree");
    m.def("default_render_settings", &defaults, "Every setting with its default.");
}

} // namespace patina
