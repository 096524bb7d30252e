// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glFunctions.h"

#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/heldFences.h"
#include "hdDelegate/raster/gl/lostContext.h"

#include <EGL/egl.h>

#include <cstdlib>
#include <cstring>

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
    GLint extensions = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &extensions);
    for (GLint i = 0; i < extensions; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, GLuint(i));
        if (name &&
            !std::strcmp(reinterpret_cast<const char*>(name), "GL_ARB_shader_draw_parameters"))
            gl.tellsDraws = glFault("singleDraws").empty();
    }
    HeldFences::install();
    const std::string losing = glFault("lostAtCall");
    if (!losing.empty()) loseContextAtCall(std::atol(losing.c_str()));
    return true;
}

} // namespace patina
