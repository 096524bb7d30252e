// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/nativeContext.h"

#include <dlfcn.h>

#include <atomic>
#include <mutex>
#include <type_traits>

namespace patina {

namespace {

// GLX and Xlib are never linked: a host that uses them has them loaded. Their types are pointers
// and numbers here, as the headers of X may be missing.
using Display = void*;
using Context = void*;
using Config = void*;
using Drawable = unsigned long;
using ErrorHandler = int (*)(Display, void*);

constexpr int contextMajor = 0x2091, contextMinor = 0x2092, contextProfile = 0x9126;
constexpr int coreProfile = 1, configId = 0x8013, screenOf = 0x800C;

struct Functions {
    Context (*GetCurrentContext)() = nullptr;
    Display (*GetCurrentDisplay)() = nullptr;
    Drawable (*GetCurrentDrawable)() = nullptr;
    Drawable (*GetCurrentReadDrawable)() = nullptr;
    int (*QueryContext)(Display, Context, int, int*) = nullptr;
    Config* (*GetFBConfigs)(Display, int, int*) = nullptr;
    int (*GetFBConfigAttrib)(Display, Config, int, int*) = nullptr;
    int (*MakeContextCurrent)(Display, Drawable, Drawable, Context) = nullptr;
    void (*DestroyContext)(Display, Context) = nullptr;
    Context (*CreateContextAttribsARB)(Display, Config, Context, int, const int*) = nullptr;
    int (*Sync)(Display, int) = nullptr;
    int (*Free)(void*) = nullptr;
    ErrorHandler (*SetErrorHandler)(ErrorHandler) = nullptr;
    bool threads = true; ///< others than the host's may call them
    std::atomic<bool> all{false};

    void find() {
        void* x = dlopen("libX11.so.6", RTLD_LAZY | RTLD_NOLOAD);
        void* glx = dlopen("libGLX.so.0", RTLD_LAZY | RTLD_NOLOAD);
        if (!glx) glx = dlopen("libGL.so.1", RTLD_LAZY | RTLD_NOLOAD);
        bool found = x && glx;
        if (!found) return;
        const auto find = [&](void* library, const char* name, auto& function) {
            using Function = std::remove_reference_t<decltype(function)>;
            function = reinterpret_cast<Function>(dlsym(library, name));
            found = found && function;
        };
        find(glx, "glXGetCurrentContext", GetCurrentContext);
        find(glx, "glXGetCurrentDisplay", GetCurrentDisplay);
        find(glx, "glXGetCurrentDrawable", GetCurrentDrawable);
        find(glx, "glXGetCurrentReadDrawable", GetCurrentReadDrawable);
        find(glx, "glXQueryContext", QueryContext);
        find(glx, "glXGetFBConfigs", GetFBConfigs);
        find(glx, "glXGetFBConfigAttrib", GetFBConfigAttrib);
        find(glx, "glXMakeContextCurrent", MakeContextCurrent);
        find(glx, "glXDestroyContext", DestroyContext);
        find(x, "XSync", Sync);
        find(x, "XFree", Free);
        find(x, "XSetErrorHandler", SetErrorHandler);
        void* (*procedure)(const char*) = nullptr;
        find(glx, "glXGetProcAddressARB", procedure);
        if (!found) return;
        CreateContextAttribsARB = reinterpret_cast<decltype(CreateContextAttribsARB)>(
            procedure("glXCreateContextAttribsARB"));
        const auto lock = static_cast<void**>(dlsym(x, "_XLockMutex_fn"));
        threads = !lock || *lock;
        all = CreateContextAttribsARB != nullptr;
    }
};

/// Of what is loaded now: a host may load GLX later.
const Functions& glx() {
    static std::mutex mutex;
    static Functions functions;
    if (!functions.all) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!functions.all) functions.find();
    }
    return functions;
}

std::atomic<bool> errorSeen{false};

/// Keeps X from ending the process where a server refuses a context.
struct ErrorGuard {
    explicit ErrorGuard(Display display) : display(display) {
        glx().Sync(display, 0);
        errorSeen = false;
        before = glx().SetErrorHandler([](Display, void*) {
            errorSeen = true;
            return 0;
        });
    }
    ~ErrorGuard() {
        glx().Sync(display, 0);
        glx().SetErrorHandler(before);
    }
    bool failed() const {
        glx().Sync(display, 0);
        return errorSeen;
    }
    Display display;
    ErrorHandler before;
};

class GlxNative final : public NativeContext {
public:
    GlxNative(Display display, Config config, Context context)
        : _display(display), _config(config), _context(context) {}
    ~GlxNative() override { glx().DestroyContext(_display, _context); }

    static std::unique_ptr<GlxNative> make(Display display, Config config, Context shared) {
        const int attributes[] = {contextMajor, 4, contextMinor, 5, contextProfile, coreProfile, 0};
        const ErrorGuard guard(display);
        const Context made = glx().CreateContextAttribsARB(display, config, shared, 1, attributes);
        return made && !guard.failed() ? std::make_unique<GlxNative>(display, config, made)
                                       : nullptr;
    }

    std::unique_ptr<NativeContext> sharing(std::string&) const override {
        return make(_display, _config, _context);
    }

    bool enter(Current& before) const override {
        before.display = glx().GetCurrentDisplay();
        before.context = glx().GetCurrentContext();
        before.draw = glx().GetCurrentDrawable();
        before.read = glx().GetCurrentReadDrawable();
        return glx().MakeContextCurrent(_display, 0, 0, _context) != 0;
    }

    void leave(const Current& before) const override {
        glx().MakeContextCurrent(before.context ? before.display : _display, before.draw,
                                 before.read, before.context);
    }

private:
    Display _display;
    Config _config;
    Context _context;
};

/// Of the framebuffers that a context is for; null where that is not known.
Config configOf(Display display, Context context) {
    int id = 0, screen = 0, count = 0;
    glx().QueryContext(display, context, configId, &id);
    glx().QueryContext(display, context, screenOf, &screen);
    Config* const all = glx().GetFBConfigs(display, screen, &count);
    Config found = nullptr;
    for (int i = 0, one = 0; i < count && !found; ++i)
        if (glx().GetFBConfigAttrib(display, all[i], configId, &one) == 0 && one == id)
            found = all[i];
    if (all) glx().Free(all);
    return found;
}

} // namespace

std::unique_ptr<NativeContext> sharingGlxCurrent(std::string& error) {
    if (!glx().all) return nullptr;
    const Context shared = glx().GetCurrentContext();
    const Display display = glx().GetCurrentDisplay();
    if (!shared || !display) return nullptr;
    if (!glx().threads) {
        error = "the host uses Xlib on one thread only (see XInitThreads)";
        return nullptr;
    }
    error = "GLX does not tell what framebuffers the host's context is for";
    const Config config = configOf(display, shared);
    if (!config) return nullptr;
    error = "GLX makes no context that shares the host's objects";
    std::unique_ptr<NativeContext> made = GlxNative::make(display, config, shared);
    if (!made) return nullptr;
    error = "GLX makes no context current without a window";
    const ErrorGuard guard(display);
    NativeContext::Current before;
    const bool works = made->enter(before);
    if (works) made->leave(before);
    return works && !guard.failed() ? std::move(made) : nullptr;
}

uintptr_t currentGlxContext() {
    return glx().all ? uintptr_t(glx().GetCurrentContext()) : 0;
}

} // namespace patina
