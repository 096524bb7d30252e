// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/eglContext.h"

#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/glFunctions.h"
#include "hdDelegate/raster/gl/heldFences.h"

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

std::string text(GLenum name) {
    const GLubyte* s = gl.GetString(name);
    return s ? reinterpret_cast<const char*>(s) : "";
}

bool has(const char* extension) {
    GLint count = 0;
    gl.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, GLuint(i));
        if (name && !std::strcmp(reinterpret_cast<const char*>(name), extension)) return true;
    }
    return false;
}

/// Features that OpenGL 4.5 leaves open and the shaders need, with a context current.
bool isEnough(std::string& error) {
    struct Limit {
        GLenum name;
        GLint needed;
        const char* what;
    };
    for (const Limit& limit :
         {Limit{GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, 3, "storage buffers in vertex shaders"},
          Limit{GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, 8, "storage buffers in fragment shaders"},
          Limit{GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, 13, "bindings of storage buffers"},
          Limit{GL_MAX_UNIFORM_BLOCK_SIZE, 63232, "bytes in a uniform block"}}) {
        GLint there = 0;
        gl.GetIntegerv(limit.name, &there);
        const bool uniforms = limit.name == GL_MAX_UNIFORM_BLOCK_SIZE;
        const std::string fault = glFault(uniforms ? "uniformBlock" : "storageBlocks");
        if (!fault.empty()) there = std::atoi(fault.c_str());
        if (there >= limit.needed) continue;
        error = "the driver has " + std::to_string(there) + " " + limit.what + ", not the " +
                std::to_string(limit.needed) + " that are needed";
        return false;
    }
    return true;
}

} // namespace

std::unique_ptr<EglContext> EglContext::create(std::string& error) {
    // Displays are shared by all contexts of a process, and so is the function table.
    static std::mutex mutex;
    const std::lock_guard<std::mutex> lock(mutex);
    const EGLenum api = eglQueryAPI();
    // Of what keeps the candidates from working, that of the first one with a driver is told.
    std::string problem;
    std::unique_ptr<EglContext> result;
    for (const EGLDisplay display : candidates()) {
        EGLint major = 0, minor = 0;
        if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) continue;
        std::string& why = problem.empty() ? problem : error;
        const EGLContext context = createOn(display, why);
        if (context == EGL_NO_CONTEXT) continue;
        std::unique_ptr<EglContext> made(new EglContext);
        made->_display = display;
        made->_context = context;
        const Use use(*made);
        if (!use.ok()) {
            why = "the driver refuses to make an OpenGL context current";
            continue;
        }
        static bool loaded = false;
        if (!loaded && !(loaded = loadGlFunctions(why))) continue;
        if (!isEnough(why)) continue;
        gl.tellsDraws = has("GL_ARB_shader_draw_parameters") && glFault("singleDraws").empty();
        made->_renderer = text(GL_RENDERER);
        made->_version = text(GL_VERSION);
        if (HeldFences::neededBy(made->_renderer)) made->_fences = std::make_unique<HeldFences>();
        result = std::move(made);
        break;
    }
    error = result ? "" : problem.empty() ? "EGL finds no display that it can initialize" : problem;
    eglBindAPI(api);
    return result;
}

std::unique_ptr<EglContext> EglContext::sharing(const EglContext& other, std::string& error) {
    const EGLenum api = eglQueryAPI();
    const EGLContext context = createOn(other._display, error, other._context);
    eglBindAPI(api);
    if (context == EGL_NO_CONTEXT) {
        if (error.empty()) error = "the driver makes no context that shares its objects";
        return nullptr;
    }
    std::unique_ptr<EglContext> made(new EglContext);
    made->_display = other._display;
    made->_context = context;
    made->_renderer = other._renderer;
    made->_version = other._version;
    if (other._fences) made->_fences = std::make_unique<HeldFences>();
    return made;
}

bool EglContext::hasHardware() {
    return !devicesOf(false).empty();
}

EglContext::EglContext() = default;

// The display stays initialized: a host may use the same one.
EglContext::~EglContext() {
    if (_fences) {
        const Use use(*this);
        if (use.ok()) _fences->release();
    }
    if (_context) eglDestroyContext(_display, _context);
}

bool EglContext::lost() const {
    return gl.GetGraphicsResetStatus() != GL_NO_ERROR;
}

EglContext::Use::Use(const EglContext& context)
    : _display(eglGetCurrentDisplay()), _context(eglGetCurrentContext()),
      _draw(eglGetCurrentSurface(EGL_DRAW)), _read(eglGetCurrentSurface(EGL_READ)),
      _api(eglQueryAPI()), _ownDisplay(context._display),
      _fences(HeldFences::makeCurrent(nullptr)) {
    eglBindAPI(EGL_OPENGL_API);
    _ok = eglMakeCurrent(context._display, EGL_NO_SURFACE, EGL_NO_SURFACE, context._context);
    if (_ok) HeldFences::makeCurrent(context._fences.get());
}

EglContext::Use::~Use() {
    HeldFences::makeCurrent(nullptr);
    if (_context == EGL_NO_CONTEXT)
        eglMakeCurrent(_ownDisplay, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    else
        eglMakeCurrent(_display, _draw, _read, _context);
    HeldFences::makeCurrent(_fences);
    eglBindAPI(_api);
}

} // namespace patina
