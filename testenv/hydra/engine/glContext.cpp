// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/engine/glContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <stdexcept>

namespace patina {

GlContext::GlContext() {
    const auto display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (!display) throw std::runtime_error("EGL has no platform displays");
    _display = display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (!_display || !eglInitialize(_display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
        throw std::runtime_error("EGL has no display without windows");
    const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION,
                             4,
                             EGL_CONTEXT_MINOR_VERSION,
                             5,
                             EGL_CONTEXT_OPENGL_PROFILE_MASK,
                             EGL_CONTEXT_OPENGL_COMPATIBILITY_PROFILE_BIT,
                             EGL_NONE};
    _context = eglCreateContext(_display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (!_context || !eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, _context))
        throw std::runtime_error("EGL makes no context of OpenGL 4.5");
}

GlContext::~GlContext() {
    eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(_display, _context);
    eglTerminate(_display);
}

} // namespace patina
