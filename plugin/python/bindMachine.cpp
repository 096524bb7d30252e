// What this build and this machine's driver call themselves: for pages that show measured times.

#ifdef PATINA_HAS_RASTER
#include "hdDelegate/raster/gl/eglContext.h"
#endif

#include <pybind11/pybind11.h>

#include <string>

namespace py = pybind11;

namespace patina {

namespace {

py::dict machine() {
    py::dict dict;
    dict["compiler"] = std::string(__VERSION__);
    for (const char* name : {"openglRenderer", "openglVersion", "openglError"})
        dict[name] = "";
#ifdef PATINA_HAS_RASTER
    std::string error;
    std::unique_ptr<EglContext> context;
    {
        const py::gil_scoped_release release;
        context = EglContext::create(error);
    }
    if (context) {
        dict["openglRenderer"] = context->renderer();
        dict["openglVersion"] = context->version();
    } else {
        dict["openglError"] = error;
    }
#else
    dict["openglError"] = "built without the rasterizer";
#endif
    return dict;
}

} // namespace

void bindMachine(py::module_& m) {
    m.def("machine", &machine,
          "A dict: compiler, openglRenderer, openglVersion, and openglError, why there is no "
          "OpenGL.");
}

} // namespace patina
