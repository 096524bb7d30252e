// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/heldFences.h"

#include <limits>

namespace patina {

namespace {

thread_local HeldFences* current = nullptr;
constexpr GLuint driversOwn = ~0u; ///< stands for a framebuffer

/// @tparam Member the function's place in `gl`: a type of its own for each
template <auto Member, typename Function> struct Holding;

template <auto Member, typename Result, typename... Arguments>
struct Holding<Member, Result(APIENTRY*)(Arguments...)> {
    static inline Result(APIENTRY* driver)(Arguments...) = nullptr;

    /// Of functions that may end a batch.
    static Result APIENTRY ends(Arguments... arguments) {
        if (current) current->hold();
        return driver(arguments...);
    }

    /// Of functions by which the driver draws into a framebuffer of its own.
    static Result APIENTRY drawsApart(Arguments... arguments) {
        if (current) current->drawsInto(driversOwn);
        return driver(arguments...);
    }

    /// Of functions that draw into the framebuffer that is bound.
    static Result APIENTRY draws(Arguments... arguments) {
        if (current) current->draws();
        return driver(arguments...);
    }
};

template <auto Member, typename Function> struct Clearing;

template <auto Member, typename... Arguments>
struct Clearing<Member, void(APIENTRY*)(GLuint, Arguments...)> {
    static inline void(APIENTRY* driver)(GLuint, Arguments...) = nullptr;

    static void APIENTRY call(GLuint framebuffer, Arguments... arguments) {
        if (current) current->clears(framebuffer);
        driver(framebuffer, arguments...);
    }
};

PFNGLBINDFRAMEBUFFERPROC bindFramebuffer = nullptr;

void APIENTRY binds(GLenum target, GLuint framebuffer) {
    if (current) current->bound(framebuffer);
    bindFramebuffer(target, framebuffer);
}

} // namespace

bool HeldFences::neededBy(const std::string& renderer) {
    return renderer.find("llvmpipe") != std::string::npos;
}

size_t HeldFences::mostTriangles() {
    return current ? size_t(16384) : std::numeric_limits<size_t>::max();
}

#define PATINA_GL_HOLD(name, NAME, how)                                                            \
    Holding<&GlFunctions::name, PFNGL##NAME##PROC>::driver = gl.name;                              \
    gl.name = Holding<&GlFunctions::name, PFNGL##NAME##PROC>::how;
#define PATINA_GL_CLEAR(name, NAME)                                                                \
    Clearing<&GlFunctions::name, PFNGL##NAME##PROC>::driver = gl.name;                             \
    gl.name = Clearing<&GlFunctions::name, PFNGL##NAME##PROC>::call;

void HeldFences::install() {
    bindFramebuffer = gl.BindFramebuffer;
    gl.BindFramebuffer = binds;
    PATINA_GL_CLEAR(ClearNamedFramebufferfv, CLEARNAMEDFRAMEBUFFERFV)
    PATINA_GL_CLEAR(ClearNamedFramebufferiv, CLEARNAMEDFRAMEBUFFERIV)
    PATINA_GL_HOLD(DrawArrays, DRAWARRAYS, draws)
    PATINA_GL_HOLD(DrawArraysInstanced, DRAWARRAYSINSTANCED, draws)
    PATINA_GL_HOLD(MultiDrawElementsIndirect, MULTIDRAWELEMENTSINDIRECT, draws)
    PATINA_GL_HOLD(QueryCounter, QUERYCOUNTER, drawsApart)
    PATINA_GL_HOLD(CopyImageSubData, COPYIMAGESUBDATA, drawsApart)
    PATINA_GL_HOLD(DeleteBuffers, DELETEBUFFERS, ends)
    PATINA_GL_HOLD(DeleteFramebuffers, DELETEFRAMEBUFFERS, ends)
    PATINA_GL_HOLD(DeleteTextures, DELETETEXTURES, ends)
    PATINA_GL_HOLD(DispatchCompute, DISPATCHCOMPUTE, ends)
    PATINA_GL_HOLD(Finish, FINISH, ends)
    PATINA_GL_HOLD(Flush, FLUSH, ends)
    PATINA_GL_HOLD(GetNamedBufferSubData, GETNAMEDBUFFERSUBDATA, ends)
    PATINA_GL_HOLD(GetQueryObjectui64v, GETQUERYOBJECTUI64V, ends)
    PATINA_GL_HOLD(GetTextureSubImage, GETTEXTURESUBIMAGE, ends)
    PATINA_GL_HOLD(MapNamedBufferRange, MAPNAMEDBUFFERRANGE, ends)
    PATINA_GL_HOLD(MemoryBarrier, MEMORYBARRIER, ends)
    PATINA_GL_HOLD(NamedBufferSubData, NAMEDBUFFERSUBDATA, ends)
    PATINA_GL_HOLD(NamedFramebufferDrawBuffers, NAMEDFRAMEBUFFERDRAWBUFFERS, ends)
    PATINA_GL_HOLD(NamedFramebufferTexture, NAMEDFRAMEBUFFERTEXTURE, ends)
    PATINA_GL_HOLD(NamedFramebufferTextureLayer, NAMEDFRAMEBUFFERTEXTURELAYER, ends)
    PATINA_GL_HOLD(ReadPixels, READPIXELS, ends)
    PATINA_GL_HOLD(TextureSubImage2D, TEXTURESUBIMAGE2D, ends)
    PATINA_GL_HOLD(TextureSubImage3D, TEXTURESUBIMAGE3D, ends)
}

#undef PATINA_GL_HOLD
#undef PATINA_GL_CLEAR

HeldFences* HeldFences::makeCurrent(HeldFences* fences) {
    HeldFences* before = current;
    if (before) before->hold();
    current = fences;
    return before;
}

void HeldFences::clears(GLuint framebuffer) {
    if (_pending && (_drawn || _framebuffer != framebuffer)) hold();
    _pending = true;
    _framebuffer = framebuffer;
}

void HeldFences::drawsInto(GLuint framebuffer) {
    clears(framebuffer);
    _drawn = true;
}

void HeldFences::hold() {
    if (!_pending) return;
    _pending = _drawn = false;
    gl.DeleteSync(_held[_next]); // null at first, which it leaves alone
    _held[_next] = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    _next = (_next + 1) % _held.size();
}

void HeldFences::release() {
    if (!_held[0]) return;
    gl.Finish();
    for (GLsync& sync : _held) {
        gl.DeleteSync(sync);
        sync = nullptr;
    }
}

} // namespace patina
