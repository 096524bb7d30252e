// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace patina {

/// An OpenGL context for renderers that draw with OpenGL. It is current on the thread that made it.
class HostGl {
public:
    /// @param glx of the X server that DISPLAY names; else of EGL, without windows
    /// @throws std::runtime_error where none can be made
    explicit HostGl(bool glx);
    ~HostGl();
    HostGl(const HostGl&) = delete;
    HostGl& operator=(const HostGl&) = delete;

    /// What the driver calls the device.
    const std::string& name() const { return _name; }
    void finish() const; ///< waits until all is drawn
    /// Reads a texture of one float for each pixel, or of four.
    /// @param depth it holds depths
    std::vector<float> read(unsigned texture, int width, int height, int channels,
                            bool depth) const;

private:
    void makeEgl();
    void makeGlx();

    bool _glx;
    void* _display = nullptr;
    void* _context = nullptr;
    std::string _name;
};

} // namespace patina
