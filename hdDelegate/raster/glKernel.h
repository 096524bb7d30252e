#pragma once

#include "hdDelegate/raster/glProgram.h"

namespace patina {

/// A GLSL function that is called for many items, each of which reads and writes storage buffers.
///
/// It runs as a vertex shader whose points are discarded. Mesa's llvmpipe makes a coroutine of each
/// compute shader, for barriers that none of these has, and compiles large ones several times as
/// long. A driver that gives vertex shaders too few storage buffers gets a compute shader.
class GlKernel {
public:
    /// @param text defines `void item(int i)`
    /// @returns null with the driver's messages in `error`
    static std::unique_ptr<GlKernel> make(const std::string& name, const std::string& text,
                                          std::string& error);

    void use() const { _program->use(); } ///< for uniforms
    /// Calls item(0) to item(count - 1) with the bindings as they are; buffers can be read after.
    void run(int count) const;

private:
    std::unique_ptr<GlProgram> _program;
    bool _compute = false;
};

} // namespace patina
