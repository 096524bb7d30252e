// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/engine/hostGl.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/gl.h>
#include <GL/glext.h>
#ifdef PATINA_HAS_GLX
#include <GL/glx.h>
#endif

#include <cstring>
#include <stdexcept>

namespace patina {

namespace {

template <class Function> Function function(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Without windows there is no framebuffer, and some of Storm's draws go to the one that it found.
void bindFramebuffer() {
    unsigned int texture = 0, framebuffer = 0;
    function<PFNGLCREATETEXTURESPROC>("glCreateTextures")(GL_TEXTURE_2D, 1, &texture);
    function<PFNGLTEXTURESTORAGE2DPROC>("glTextureStorage2D")(texture, 1, GL_RGBA8, 1, 1);
    function<PFNGLCREATEFRAMEBUFFERSPROC>("glCreateFramebuffers")(1, &framebuffer);
    function<PFNGLNAMEDFRAMEBUFFERTEXTUREPROC>("glNamedFramebufferTexture")(
        framebuffer, GL_COLOR_ATTACHMENT0, texture, 0);
    function<PFNGLBINDFRAMEBUFFERPROC>("glBindFramebuffer")(GL_FRAMEBUFFER, framebuffer);
}

/// A display without windows: that of a graphics processor before any of software.
EGLDisplay windowless() {
    const auto display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const auto devicesOf = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto textOf = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
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

HostGl::HostGl(bool glx) : _glx(glx) {
    glx ? makeGlx() : makeEgl();
    bindFramebuffer();
    if (const auto* name = function<decltype(&glGetString)>("glGetString")(GL_RENDERER))
        _name = reinterpret_cast<const char*>(name);
}

void HostGl::makeEgl() {
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
}

void HostGl::makeGlx() {
#ifdef PATINA_HAS_GLX
    Display* display = XOpenDisplay(nullptr);
    if (!display) throw std::runtime_error("there is no X server");
    _display = display;
    const int screen = DefaultScreen(display);
    const int form[] = {GLX_DRAWABLE_TYPE, GLX_PBUFFER_BIT, GLX_RENDER_TYPE, GLX_RGBA_BIT, None};
    int count = 0;
    GLXFBConfig* configs = glXChooseFBConfig(display, screen, form, &count);
    if (!configs || count < 1) throw std::runtime_error("GLX has no such framebuffer");
    const GLXFBConfig config = configs[0];
    XFree(configs);
    const int wanted[] = {GLX_CONTEXT_MAJOR_VERSION_ARB,
                          4,
                          GLX_CONTEXT_MINOR_VERSION_ARB,
                          5,
                          GLX_CONTEXT_PROFILE_MASK_ARB,
                          GLX_CONTEXT_COMPATIBILITY_PROFILE_BIT_ARB,
                          None};
    const auto create = reinterpret_cast<PFNGLXCREATECONTEXTATTRIBSARBPROC>(
        glXGetProcAddressARB(reinterpret_cast<const GLubyte*>("glXCreateContextAttribsARB")));
    const GLXContext context = create ? create(display, config, nullptr, True, wanted) : nullptr;
    const int size[] = {GLX_PBUFFER_WIDTH, 1, GLX_PBUFFER_HEIGHT, 1, None};
    const GLXPbuffer pbuffer = glXCreatePbuffer(display, config, size);
    if (!context || !glXMakeContextCurrent(display, pbuffer, pbuffer, context))
        throw std::runtime_error("GLX makes no context of OpenGL 4.5");
    _context = context;
#else
    throw std::runtime_error("GLX was not found when this was built");
#endif
}

HostGl::~HostGl() {
#ifdef PATINA_HAS_GLX
    if (_glx) {
        auto* display = static_cast<Display*>(_display);
        glXMakeContextCurrent(display, None, None, nullptr);
        glXDestroyContext(display, static_cast<GLXContext>(_context));
        XCloseDisplay(display);
        return;
    }
#endif
    eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(_display, _context);
    eglTerminate(_display);
}

void HostGl::finish() const {
    function<decltype(&glFinish)>("glFinish")();
}

std::vector<float> HostGl::read(unsigned texture, int width, int height, int channels,
                                bool depth) const {
    std::vector<float> pixels(size_t(width) * size_t(height) * size_t(channels));
    function<PFNGLGETTEXTUREIMAGEPROC>("glGetTextureImage")(
        texture, 0,
        depth           ? GL_DEPTH_COMPONENT
        : channels == 1 ? GL_RED
                        : GL_RGBA,
        GL_FLOAT, GLsizei(pixels.size() * sizeof(float)), pixels.data());
    return pixels;
}

} // namespace patina
