// SPDX-License-Identifier: Apache-2.0
// Names of this build and of this machine's driver, for pages that show measured times.

#ifdef PATINA_HAS_RASTER
#include "hdDelegate/raster/gl/glContext.h"
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
    std::unique_ptr<GlContext> context;
    {
        const py::gil_scoped_release release;
        context = GlContext::create(error);
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

/// The conditions that the arithmetic of a render depends on, besides the text: what the compiler
/// may use, what Embree chooses from when it runs, and the machine's own processor.
std::string instructionSet() {
    std::string built = "generic";
#if defined(__x86_64__)
    built = "x86-64";
#elif defined(__aarch64__)
    built = "aarch64";
#endif
#ifdef __AVX2__
    built += " AVX2";
#endif
#ifdef __FMA__
    built += " FMA";
#endif
#ifdef __AVX512F__
    built += " AVX512";
#endif
    std::string found;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("sse4.2")) found = "SSE4.2";
    if (__builtin_cpu_supports("avx")) found = "AVX";
    if (__builtin_cpu_supports("avx2")) found = "AVX2";
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq")) found = "AVX512";
#endif
    return built + (found.empty() ? "" : ", on " + found);
}

} // namespace

void bindMachine(py::module_& m) {
    m.def("instruction_set", &instructionSet,
          "The arithmetic of this build, in words: renders of two machines have equal bits where "
          "build and instruction set are equal.");
    m.def("machine", &machine,
          "A dict: compiler, openglRenderer, openglVersion, and openglError, why there is no "
          "OpenGL.");
}

} // namespace patina
