#include "hdDelegate/raster/eglContext.h"

#include "hdDelegate/raster/glFunctions.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <cstdlib>
#include <cstring>
#include <mutex>
#include <vector>

namespace patina {

namespace {

bool has(const char* extensions, const char* name) {
    const size_t length = std::strlen(name);
    for (const char* at = extensions; at && (at = std::strstr(at, name)); at += length)
        if (at[length] == ' ' || at[length] == '\0') return true;
    return false;
}

template <typename Function> Function eglFunction(const char* name) {
    return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// Displays to try, best first.
std::vector<EGLDisplay> candidates() {
    const char* only = std::getenv("PATINA_EGL_PLATFORM");
    const auto wanted = [&](const char* kind) { return !only || std::strcmp(only, kind) == 0; };
    std::vector<EGLDisplay> hardware, software, all;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto platformDisplay =
        eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto queryDevice = eglFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    if (platformDisplay && queryDevices && queryDevice && wanted("device") &&
        has(client, "EGL_EXT_platform_device")) {
        EGLDeviceEXT devices[16];
        EGLint count = 0;
        if (queryDevices(16, devices, &count))
            for (EGLint i = 0; i < count; ++i) {
                const EGLDisplay d = platformDisplay(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
                const bool soft =
                    has(queryDevice(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software");
                if (d != EGL_NO_DISPLAY) (soft ? software : hardware).push_back(d);
            }
    }
    all = hardware;
    if (platformDisplay && wanted("surfaceless") && has(client, "EGL_MESA_platform_surfaceless"))
        all.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                      reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr));
    all.insert(all.end(), software.begin(), software.end());
    if (wanted("default")) all.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return all;
}

EGLContext createOn(EGLDisplay display, std::string& error) {
    EGLint major = 0, minor = 0;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) {
        error = "EGL finds no display that it can initialize";
        return EGL_NO_CONTEXT;
    }
    const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
    if (!has(extensions, "EGL_KHR_surfaceless_context")) {
        error = "EGL cannot make a context without a surface";
        return EGL_NO_CONTEXT;
    }
    if (!eglBindAPI(EGL_OPENGL_API)) {
        error = "EGL has no OpenGL, only OpenGL ES";
        return EGL_NO_CONTEXT;
    }
    const EGLint configAttributes[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    if (!eglChooseConfig(display, configAttributes, &config, 1, &count) || count < 1)
        config = EGL_NO_CONFIG_KHR;
    std::vector<EGLint> attributes = {
        EGL_CONTEXT_MAJOR_VERSION,       4,
        EGL_CONTEXT_MINOR_VERSION,       5,
        EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT};
    const size_t plain = attributes.size();
    if (has(extensions, "EGL_EXT_create_context_robustness"))
        attributes.insert(attributes.end(), {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT,
                                             EGL_LOSE_CONTEXT_ON_RESET_EXT});
    attributes.push_back(EGL_NONE);
    EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    if (context == EGL_NO_CONTEXT && attributes.size() > plain + 1) {
        attributes.resize(plain);
        attributes.push_back(EGL_NONE);
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
    }
    if (context == EGL_NO_CONTEXT) error = "the driver has no OpenGL 4.5 core profile";
    return context;
}

std::string text(GLenum name) {
    const GLubyte* s = gl.GetString(name);
    return s ? reinterpret_cast<const char*>(s) : "";
}

} // namespace

std::unique_ptr<EglContext> EglContext::create(std::string& error) {
    // Displays are shared by all contexts of a process, and so is the function table.
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    const EGLenum api = eglQueryAPI();
    error = "there is no EGL display";
    std::unique_ptr<EglContext> result;
    for (const EGLDisplay display : candidates()) {
        const EGLContext context = createOn(display, error);
        if (context == EGL_NO_CONTEXT) continue;
        std::unique_ptr<EglContext> made(new EglContext);
        made->_display = display;
        made->_context = context;
        const Use use(*made);
        if (!use.ok()) {
            error = "the driver refuses to make an OpenGL context current";
            continue;
        }
        static bool loaded = false;
        if (!loaded && !(loaded = loadGlFunctions(error))) continue;
        made->_renderer = text(GL_RENDERER);
        made->_version = text(GL_VERSION);
        error.clear();
        result = std::move(made);
        break;
    }
    eglBindAPI(api);
    return result;
}

// The display stays initialized: a host may use the same one.
EglContext::~EglContext() {
    if (_context) eglDestroyContext(_display, _context);
}

bool EglContext::lost() const {
    return gl.GetGraphicsResetStatus() != GL_NO_ERROR;
}

EglContext::Use::Use(const EglContext& context)
    : _display(eglGetCurrentDisplay()), _context(eglGetCurrentContext()),
      _draw(eglGetCurrentSurface(EGL_DRAW)), _read(eglGetCurrentSurface(EGL_READ)),
      _api(eglQueryAPI()), _ownDisplay(context._display) {
    eglBindAPI(EGL_OPENGL_API);
    _ok = eglMakeCurrent(context._display, EGL_NO_SURFACE, EGL_NO_SURFACE, context._context);
}

EglContext::Use::~Use() {
    if (_context == EGL_NO_CONTEXT)
        eglMakeCurrent(_ownDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    else
        eglMakeCurrent(_display, _draw, _read, _context);
    eglBindAPI(_api);
}

} // namespace patina
