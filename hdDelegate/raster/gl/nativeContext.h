// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace patina {

/// A context of OpenGL as a window system makes it.
class NativeContext {
public:
    /// What a thread has current.
    struct Current {
        void *display = nullptr, *context = nullptr;
        uintptr_t draw = 0, read = 0;
        unsigned api = 0; ///< of EGL
    };

    virtual ~NativeContext() = default; ///< must not be current
    /// One that shares objects with it. @returns null with a one-line reason
    virtual std::unique_ptr<NativeContext> sharing(std::string& error) const = 0;
    /// Makes it current on this thread, without a surface.
    virtual bool enter(Current& before) const = 0;
    /// Makes current again what enter() found.
    virtual void leave(const Current& before) const = 0;
};

/// Offers EGL's contexts without display or window, one on each display, best first.
/// @param accept says what is wrong with one; nothing: it is the last
/// @returns nothing, or in one line what is wrong with the first that has a driver
std::string
tryEglContexts(const std::function<std::string(std::unique_ptr<NativeContext>)>& accept);
/// Whether EGL knows a device that is not software.
bool eglHasHardware();

/// Contexts that share objects with the one that is current on this thread, if it is EGL's or
/// GLX's.
/// @returns null, with a one-line reason if there is one that cannot be shared
std::unique_ptr<NativeContext> sharingEglCurrent(std::string& error);
std::unique_ptr<NativeContext> sharingGlxCurrent(std::string& error);
/// The context that is current on this thread, as a number; 0: none.
uintptr_t currentNativeContext();
uintptr_t currentGlxContext();

} // namespace patina
