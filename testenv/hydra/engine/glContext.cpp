// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/engine/glContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

/// Without windows there is no framebuffer, and some of Storm's draws go to the one that it found.
void bindFramebuffer() {
    const auto function = [](const char* name) { return eglGetProcAddress(name); };
    unsigned int texture = 0, framebuffer = 0;
    reinterpret_cast<PFNGLCREATETEXTURESPROC>(function("glCreateTextures"))(GL_TEXTURE_2D, 1,
                                                                            &texture);
    reinterpret_cast<PFNGLTEXTURESTORAGE2DPROC>(function("glTextureStorage2D"))(texture, 1,
                                                                                GL_RGBA8, 1, 1);
    reinterpret_cast<PFNGLCREATEFRAMEBUFFERSPROC>(function("glCreateFramebuffers"))(1,
                                                                                    &framebuffer);
    reinterpret_cast<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>(function("glNamedFramebufferTexture"))(
        framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    reinterpret_cast<PFNGLBINDFRAMEBUFFERPROC>(function("glBindFramebuffer"))(GL_FRAMEBUFFER,
                                                                              framebuffer);
}

/// A display without windows: that of a graphics processor before any of software.
EGLDisplay windowless() {
    const auto display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(
        eglGetProcAddress("eglGetPlatformDisplayEXT"));
    const auto devicesOf =
        reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    const auto textOf = reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(
        eglGetProcAddress("eglQueryDeviceStringEXT"));
    if (!display) throw std::runtime_error("EGL has no platform displays");
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (devicesOf && textOf && devicesOf(16, devices, &count))
        for (EGLint i = 0; i < count; ++i) {
            const char* extensions = textOf(devices[i], EGL_EXTENSIONS);
            if (extensions && std::strstr(extensions, "EGL_MESA_device_software")) continue;
            const EGLDisplay found = display(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
            if (found && eglInitialize(found, nullptr, nullptr)) return found;
        }
    const EGLDisplay software =
        display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (!software || !eglInitialize(software, nullptr, nullptr))
        throw std::runtime_error("EGL has no display without windows");
    return software;
}

} // namespace

GlContext::GlContext() {
    _display = windowless();
    if (!eglBindAPI(EGL_OPENGL_API)) throw std::runtime_error("EGL has no OpenGL");
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
    bindFramebuffer();
    const auto text = reinterpret_cast<decltype(&glGetString)>(eglGetProcAddress("glGetString"));
    if (const auto* name = text(GL_RENDERER)) _name = reinterpret_cast<const char*>(name);
}

GlContext::~GlContext() {
    eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(_display, _context);
    eglTerminate(_display);
}

} // namespace patina
