// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/nativeContext.h"

#include <memory>
#include <string>

namespace patina {

class HeldFences;

/// An OpenGL 4.5 core context without display or window. Belongs to one thread at a time.
class GlContext {
public:
    /// A context of its own. Candidates in this order: the EGL devices that are hardware, Mesa's
    /// surfaceless platform, the software devices, the default display. The environment variable
    /// PATINA_EGL_PLATFORM (device, surfaceless or default) leaves only one kind.
    /// @returns null with a one-line reason in `error`
    static std::unique_ptr<GlContext> create(std::string& error);
    /// A context that shares objects with another one, for another thread.
    /// @returns null with a one-line reason in `error`
    static std::unique_ptr<GlContext> sharing(const GlContext& other, std::string& error);
    /// A context that shares objects with the host's, which is current on this thread.
    /// @returns null with a one-line reason in `error`
    static std::unique_ptr<GlContext> sharingCurrent(std::string& error);
    ~GlContext(); ///< must not be current on another thread

    const std::string& renderer() const {
        return _renderer;
    }                                                       ///< "llvmpipe (LLVM 15.0.6, 256 bits)"
    const std::string& version() const { return _version; } ///< "4.5 (Core Profile) Mesa 22.3.6"

    /// Makes a context current for a scope, and then again whatever the host had current.
    class Use {
    public:
        explicit Use(const GlContext& context);
        ~Use();
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        bool ok() const { return _ok; } ///< false: the context cannot be used by this thread

    private:
        const NativeContext& _native;
        NativeContext::Current _before;
        HeldFences* _fences; ///< that were current before
        bool _ok;
    };

    /// True after the driver reset (GPU hang, driver update): all objects are gone, make a new
    /// context. Call with the context current.
    bool lost() const;

    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

private:
    explicit GlContext(std::unique_ptr<NativeContext> native);
    static std::unique_ptr<GlContext> checked(std::unique_ptr<NativeContext> native,
                                              std::string& error);

    std::unique_ptr<NativeContext> _native;
    std::string _renderer, _version;
    std::unique_ptr<HeldFences> _fences; ///< of drivers that need it
};

} // namespace patina
