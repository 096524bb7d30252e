// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glFunctions.h"

#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/heldFences.h"
#include "hdDelegate/raster/gl/lostContext.h"

#include <EGL/egl.h>

#include <cstdlib>

namespace patina {

GlFunctions gl;

bool loadGlFunctions(std::string& error) {
#define PATINA_GL_LOAD(name, NAME)                                                                 \
    gl.name = reinterpret_cast<PFNGL##NAME##PROC>(eglGetProcAddress("gl" #name));                  \
    if (!gl.name) {                                                                                \
        error = "the OpenGL driver has no function gl" #name;                                      \
        return false;                                                                              \
    }
    PATINA_GL_FUNCTIONS(PATINA_GL_LOAD)
#undef PATINA_GL_LOAD
    HeldFences::install();
    const std::string losing = glFault("lostAtCall");
    if (!losing.empty()) loseContextAtCall(std::atol(losing.c_str()));
    return true;
}

} // namespace patina
