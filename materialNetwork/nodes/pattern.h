// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/shadingPoint.h"
#include "materialNetwork/textureSource.h"
#include "materialNetwork/network/network.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>

namespace patina {

/// Compile-time data of an instruction.
struct PatternData {
    int size = 1;    ///< components of the first input
    int handle = -1; ///< texture
    int slot = -1;   ///< primvar
    int mode = 0;    ///< whatever a string or uniform input selects
    glm::vec4 value{0.0f};
};

/// Run-time data of an instruction. While constants are folded there is no point.
struct PatternContext {
    const ShadingPoint* point = nullptr;
    const TextureSource* textures = nullptr;
};

/// One call of a pattern function. Values live in registers of four floats. A scalar fills all four
/// components, so that scalar-vector variants of a node share their function; components beyond
/// the size of a vector hold anything.
struct PatternCall {
    glm::vec4* registers;
    const uint16_t* inputs; ///< register of each input of the node definition
    uint16_t output;        ///< register of the first output, further ones follow
    const PatternData& data;
    const PatternContext& context;

    const glm::vec4& in(int i) const { return registers[inputs[i]]; }
    float x(int i) const { return registers[inputs[i]].x; }
    /// An integer input; 0 for what is no number, and limited far beyond what any node knows.
    int whole(int i) const {
        const float v = x(i);
        return v > -1e9f ? int(v < 1e9f ? v : 1e9f) : v <= -1e9f ? -1000000000 : 0;
    }
    glm::vec4& out(int i = 0) const { return registers[output + i]; }
    const ShadingPoint& point() const { return *context.point; }
};

using PatternFunction = void (*)(const PatternCall& call);

/// The computation of a node, for both back ends: rows of nodes name it, and so does what is
/// compiled of them.
///
/// The text has the outputs as GLSL expressions, separated by `;`. $0..$9 and ${10}... are inputs
/// (all vec4), $A0 and $B0 input 0 as mat3 and mat4; $s is the size of the first input, $m the
/// mode, $p the slot of the primvar. $t(uv, footprint) reads the texture and is input 1 where there
/// is none; $X, $Y and $Z do so with the three textures of a projection and input 3. A text that
/// begins with `3|` or `4|` is a matrix: an output for each of its rows.
struct Pattern {
    PatternFunction function = nullptr;
    const char* glsl = nullptr;
    const char* glslWithout = nullptr; ///< in place of `glsl` where there is no texture
    bool rare = false;                 ///< the text needs shaders/raster/moreNodes.glsl
    bool spectral = false;             ///< reads ShadingPoint::wavelength
};

constexpr Pattern pattern(const char* glsl, PatternFunction function) {
    return {function, glsl, nullptr, false};
}
/// That has other values for each wavelength; the text is that for no one wavelength.
constexpr Pattern spectralPattern(const char* glsl, PatternFunction function) {
    return {function, glsl, nullptr, false, true};
}
constexpr Pattern pattern(const char* glsl, const char* without, PatternFunction function) {
    return {function, glsl, without, false};
}
/// With functions of shaders/raster/moreNodes.glsl beside those of shaders/raster/material.glsl.
constexpr Pattern rarePattern(const char* glsl, PatternFunction function) {
    return {function, glsl, nullptr, true};
}
constexpr Pattern rarePattern(const char* glsl, const char* without, PatternFunction function) {
    return {function, glsl, without, true};
}

/// Requests that a node may make while its instruction is compiled.
class PatternSetup {
public:
    virtual ~PatternSetup() = default;
    /// @returns the constant value of an input (its default when not authored), or null when the
    /// input varies
    virtual const Value* constant(const char* input) const = 0;
    virtual bool authored(const char* input) const = 0;
    virtual int openTexture(const TextureRequest& request) = 0;
    virtual bool textureValid(int handle) const = 0;
    virtual int primvarSlot(const std::string& name, ValueType type) = 0;
    virtual void warn(const char* input, const std::string& message) = 0;

    std::string text(const char* input) const {
        const Value* v = constant(input);
        return v ? v->text : std::string();
    }
    float number(const char* input, float fallback) const {
        const Value* v = constant(input);
        return v && !v->numbers.empty() ? v->numbers[0] : fallback;
    }
};

using PatternPrepare = void (*)(PatternSetup& setup, PatternData& data);

} // namespace patina
