// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glContext.h"
#include "hdDelegate/renderer/hostDevice.h"

#include <functional>
#include <memory>
#include <mutex>
#include <string>

namespace patina {

/// The OpenGL of a host: contexts that share objects with the one that is current on its thread.
class HostContext final : public HostDevice {
public:
    /// @returns null with a one-line reason, and without one where no context is current
    static std::shared_ptr<HostContext> current(std::string& why);

    bool isCurrent() const override { return currentNativeContext() == _host; }
    /// A context for a thread of ours. @returns null with a one-line reason
    std::unique_ptr<GlContext> share(std::string& error) const {
        return GlContext::sharing(*_own, error);
    }
    /// Runs a function on any thread, with the host's context if that is current there, and else
    /// with one of ours, one after another. It leaves OpenGL's state as it is.
    /// @returns false, and does not run it, where neither can be used
    bool use(const std::function<void()>& function) const;

private:
    uintptr_t _host = 0;
    std::unique_ptr<GlContext> _own;
    mutable std::mutex _mutex;
};

} // namespace patina
