// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/nativeContext.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

#include <cstdlib>
#include <cstring>
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

bool wanted(const char* kind) {
    const char* only = std::getenv("PATINA_EGL_PLATFORM");
    return !only || std::strcmp(only, kind) == 0;
}

/// EGL's devices of one kind.
std::vector<EGLDeviceEXT> devicesOf(bool software) {
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto queryDevices = eglFunction<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
    const auto queryDevice = eglFunction<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
    std::vector<EGLDeviceEXT> found;
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    if (!queryDevices || !queryDevice || !wanted("device") ||
        !has(client, "EGL_EXT_platform_device") || !queryDevices(16, devices, &count))
        return found;
    for (EGLint i = 0; i < count; ++i)
        if (has(queryDevice(devices[i], EGL_EXTENSIONS), "EGL_MESA_device_software") == software)
            found.push_back(devices[i]);
    return found;
}

/// Displays to try, best first.
std::vector<EGLDisplay> candidates() {
    std::vector<EGLDisplay> hardware, software, all;
    const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    const auto platformDisplay =
        eglFunction<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
    for (const bool soft : {false, true})
        for (const EGLDeviceEXT device : devicesOf(soft)) {
            const EGLDisplay d = platformDisplay
                                     ? platformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr)
                                     : EGL_NO_DISPLAY;
            if (d != EGL_NO_DISPLAY) (soft ? software : hardware).push_back(d);
        }
    all = hardware;
    if (platformDisplay && wanted("surfaceless") && has(client, "EGL_MESA_platform_surfaceless"))
        all.push_back(platformDisplay(EGL_PLATFORM_SURFACELESS_MESA,
                                      reinterpret_cast<void*>(EGL_DEFAULT_DISPLAY), nullptr));
    all.insert(all.end(), software.begin(), software.end());
    if (wanted("default")) all.push_back(eglGetDisplay(EGL_DEFAULT_DISPLAY));
    return all;
}

/// " (it has ...)" for a message, where any core context can be made.
std::string versionThere(EGLDisplay display, EGLConfig config) {
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
                                 EGL_NONE};
    const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
    if (context == EGL_NO_CONTEXT) return std::string();
    const EGLDisplay before = eglGetCurrentDisplay();
    const EGLContext current = eglGetCurrentContext();
    const EGLSurface draw = eglGetCurrentSurface(EGL_DRAW), read = eglGetCurrentSurface(EGL_READ);
    std::string found;
    const auto getString = eglFunction<PFNGLGETSTRINGPROC>("glGetString");
    if (getString && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        const GLubyte* version = getString(GL_VERSION);
        if (version)
            found = std::string(" (it has ") + reinterpret_cast<const char*>(version) + ")";
        eglMakeCurrent(current == EGL_NO_CONTEXT ? display : before, draw, read, current);
    }
    eglDestroyContext(display, context);
    return found;
}

EGLContext createOn(EGLDisplay display, std::string& error, EGLContext shared = EGL_NO_CONTEXT) {
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
    EGLContext context = eglCreateContext(display, config, shared, attributes.data());
    if (context == EGL_NO_CONTEXT && attributes.size() > plain + 1) {
        attributes.resize(plain);
        attributes.push_back(EGL_NONE);
        context = eglCreateContext(display, config, shared, attributes.data());
    }
    if (context == EGL_NO_CONTEXT)
        error = "the driver has no OpenGL 4.5 core profile" + versionThere(display, config);
    return context;
}

std::unique_ptr<NativeContext> sharingOn(EGLDisplay display, EGLContext shared, std::string& error);

class EglNative final : public NativeContext {
public:
    EglNative(EGLDisplay display, EGLContext context) : _display(display), _context(context) {}
    // The display stays initialized: a host may use the same one.
    ~EglNative() override { eglDestroyContext(_display, _context); }

    std::unique_ptr<NativeContext> sharing(std::string& error) const override {
        return sharingOn(_display, _context, error);
    }

    bool enter(Current& before) const override {
        before.display = eglGetCurrentDisplay();
        before.context = eglGetCurrentContext();
        before.draw = uintptr_t(eglGetCurrentSurface(EGL_DRAW));
        before.read = uintptr_t(eglGetCurrentSurface(EGL_READ));
        before.api = eglQueryAPI();
        eglBindAPI(EGL_OPENGL_API);
        return eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, _context);
    }

    void leave(const Current& before) const override {
        if (before.context == EGL_NO_CONTEXT)
            eglMakeCurrent(_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        else if (!eglMakeCurrent(before.display, EGLSurface(before.draw), EGLSurface(before.read),
                                 before.context)) // its window may be gone
            eglMakeCurrent(before.display, EGL_NO_SURFACE, EGL_NO_SURFACE, before.context);
        eglBindAPI(before.api);
    }

private:
    EGLDisplay _display;
    EGLContext _context;
};

std::unique_ptr<NativeContext> sharingOn(EGLDisplay display, EGLContext shared,
                                         std::string& error) {
    const EGLenum api = eglQueryAPI();
    const EGLContext context = createOn(display, error, shared);
    eglBindAPI(api);
    if (context == EGL_NO_CONTEXT) return nullptr;
    return std::make_unique<EglNative>(display, context);
}

} // namespace

std::string
tryEglContexts(const std::function<std::string(std::unique_ptr<NativeContext>)>& accept) {
    const EGLenum api = eglQueryAPI();
    std::string problem;
    bool accepted = false;
    for (const EGLDisplay display : candidates()) {
        EGLint major = 0, minor = 0;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) continue;
        std::string why;
        const EGLContext context = createOn(display, why);
        if (context != EGL_NO_CONTEXT) why = accept(std::make_unique<EglNative>(display, context));
        accepted = context != EGL_NO_CONTEXT && why.empty();
        if (accepted) break;
        if (problem.empty()) problem = why;
    }
    eglBindAPI(api);
    return accepted          ? ""
           : problem.empty() ? "EGL finds no display that it can initialize"
                             : problem;
}

bool eglHasHardware() {
    return !devicesOf(false).empty();
}

std::unique_ptr<NativeContext> sharingEglCurrent(std::string& error) {
    const EGLDisplay display = eglGetCurrentDisplay();
    const EGLContext shared = eglGetCurrentContext();
    if (shared == EGL_NO_CONTEXT) return nullptr;
    return sharingOn(display, shared, error);
}

uintptr_t currentNativeContext() {
    const auto context = uintptr_t(eglGetCurrentContext());
    return context ? context : currentGlxContext();
}

} // namespace patina
