// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/lostContext.h"

#include "hdDelegate/raster/gl/glFunctions.h"

#include <atomic>

namespace patina {

namespace {

std::atomic<long> callsLeft{0};

bool lost() {
    return callsLeft.load() <= 0 || callsLeft.fetch_sub(1) <= 1;
}

/// @tparam Member the function's place in `gl`: a type of its own for each
template <auto Member, typename Function> struct Losing;

template <auto Member, typename Result, typename... Arguments>
struct Losing<Member, Result(APIENTRY*)(Arguments...)> {
    static inline Result(APIENTRY* driver)(Arguments...) = nullptr;

    static Result APIENTRY call(Arguments... arguments) {
        if (lost()) return Result();
        return driver(arguments...);
    }
};

// These answer still: else nobody would know, or wait without end (OpenGL 4.6, 2.3.2).
GLenum APIENTRY error() {
    return lost() ? GL_CONTEXT_LOST : Losing<&GlFunctions::GetError, PFNGLGETERRORPROC>::driver();
}

GLenum APIENTRY resetStatus() {
    if (lost()) return GL_UNKNOWN_CONTEXT_RESET;
    return Losing<&GlFunctions::GetGraphicsResetStatus, PFNGLGETGRAPHICSRESETSTATUSPROC>::driver();
}

void APIENTRY queryResult(GLuint query, GLenum what, GLuint64* result) {
    if (lost())
        *result = what == GL_QUERY_RESULT_AVAILABLE ? GL_TRUE : 0;
    else
        Losing<&GlFunctions::GetQueryObjectui64v, PFNGLGETQUERYOBJECTUI64VPROC>::driver(query, what,
                                                                                        result);
}

} // namespace

void loseContextAtCall(long number) {
    callsLeft = number;
#define PATINA_GL_LOSE(name, NAME)                                                                 \
    Losing<&GlFunctions::name, PFNGL##NAME##PROC>::driver = gl.name;                               \
    gl.name = Losing<&GlFunctions::name, PFNGL##NAME##PROC>::call;
    PATINA_GL_FUNCTIONS(PATINA_GL_LOSE)
#undef PATINA_GL_LOSE
    gl.GetError = error;
    gl.GetGraphicsResetStatus = resetStatus;
    gl.GetQueryObjectui64v = queryResult;
}

} // namespace patina
