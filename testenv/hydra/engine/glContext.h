// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// An OpenGL context of EGL without windows, for renderers that draw with OpenGL. It is current on
/// the thread that made it.
class GlContext {
public:
    /// @throws std::runtime_error when EGL makes none
    GlContext();
    ~GlContext();
    GlContext(const GlContext&) = delete;
    GlContext& operator=(const GlContext&) = delete;

    /// What the driver calls the device.
    const std::string& name() const { return _name; }

private:
    void* _display = nullptr;
    void* _context = nullptr;
    std::string _name;
};

} // namespace patina
