#pragma once

#include <cstddef>

namespace patina {

/// A node's outputs as GLSL expressions, separated by `;`.
///
/// $0..$9 and ${10}... are inputs (all vec4), $A0 and $B0 input 0 as mat3 and mat4; $s is the size
/// of the first input, $m the mode, $p the slot of the primvar. $t(uv, footprint) reads the texture
/// and is input 1 where there is none; $X, $Y and $Z do so with the three textures of a projection
/// and input 3. A text that begins with `3|` or `4|` is a matrix: an output for each of its rows.
/// Nodes that share their C++ function share the row.
struct GlslPatternRow {
    const char* id;
    const char* text;
    const char* without = nullptr; ///< in place of `text` where there is no texture
};

struct GlslPatternRows {
    const GlslPatternRow* begin;
    size_t size;
};

GlslPatternRows glslCommonPatterns(); ///< over shaders/raster/material.glsl
GlslPatternRows glslRarePatterns();   ///< need shaders/raster/moreNodes.glsl as well

} // namespace patina
