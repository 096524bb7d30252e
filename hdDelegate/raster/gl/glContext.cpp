// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/gl/glContext.h"

#include "hdDelegate/raster/gl/glFaults.h"
#include "hdDelegate/raster/gl/glFunctions.h"
#include "hdDelegate/raster/gl/heldFences.h"

#include <cstdlib>
#include <cstring>
#include <mutex>

namespace patina {

namespace {

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

/// Displays are shared by all contexts of a process, and so is the function table.
std::mutex& making() {
    static std::mutex mutex;
    return mutex;
}

} // namespace

/// With making() held. @returns null, with a reason, where the driver lacks something
std::unique_ptr<GlContext> GlContext::checked(std::unique_ptr<NativeContext> native,
                                              std::string& error) {
    std::unique_ptr<GlContext> made(new GlContext(std::move(native)));
    const Use use(*made);
    if (!use.ok()) {
        error = "the driver refuses to make an OpenGL context current";
        return nullptr;
    }
    static bool loaded = false;
    if (!loaded && !(loaded = loadGlFunctions(error))) return nullptr;
    if (!isEnough(error)) return nullptr;
    gl.tellsDraws = has("GL_ARB_shader_draw_parameters") && glFault("singleDraws").empty();
    made->_renderer = text(GL_RENDERER);
    made->_version = text(GL_VERSION);
    if (HeldFences::neededBy(made->_renderer)) made->_fences = std::make_unique<HeldFences>();
    return made;
}

std::unique_ptr<GlContext> GlContext::create(std::string& error) {
    const std::lock_guard<std::mutex> lock(making());
    std::unique_ptr<GlContext> made;
    error = tryEglContexts([&](std::unique_ptr<NativeContext> native) {
        std::string why;
        made = checked(std::move(native), why);
        return why;
    });
    return made;
}

std::unique_ptr<GlContext> GlContext::sharing(const GlContext& other, std::string& error) {
    auto native = other._native->sharing(error);
    if (!native) {
        if (error.empty()) error = "the driver makes no context that shares its objects";
        return nullptr;
    }
    std::unique_ptr<GlContext> made(new GlContext(std::move(native)));
    made->_renderer = other._renderer;
    made->_version = other._version;
    if (other._fences) made->_fences = std::make_unique<HeldFences>();
    return made;
}

std::unique_ptr<GlContext> GlContext::sharingCurrent(std::string& error) {
    const std::lock_guard<std::mutex> lock(making());
    error = "no context of EGL or GLX is current";
    if (!glFault("sharing").empty()) return nullptr;
    auto native = sharingEglCurrent(error);
    if (!native) native = sharingGlxCurrent(error);
    return native ? checked(std::move(native), error) : nullptr;
}

GlContext::GlContext(std::unique_ptr<NativeContext> native) : _native(std::move(native)) {}

GlContext::~GlContext() {
    if (!_fences) return;
    const Use use(*this);
    if (use.ok()) _fences->release();
}

bool GlContext::lost() const {
    return gl.GetGraphicsResetStatus() != GL_NO_ERROR;
}

GlContext::Use::Use(const GlContext& context)
    : _native(*context._native), _fences(HeldFences::makeCurrent(nullptr)) {
    _ok = _native.enter(_before);
    if (_ok) HeldFences::makeCurrent(context._fences.get());
}

GlContext::Use::~Use() {
    HeldFences::makeCurrent(nullptr);
    _native.leave(_before);
    HeldFences::makeCurrent(_fences);
}

} // namespace patina
