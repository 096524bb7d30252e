// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "materialNetwork/shadingPoint.h"
#include "materialNetwork/textureSource.h"
#include "materialNetwork/network/network.h"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <string>

namespace patina {

/// Compile-time data of an instruction.
struct PatternData {
    int size = 1;                   ///< components of the first input
    int textures[3] = {-1, -1, -1}; ///< handles, in the order of the function's parameters
    int slot = -1;                  ///< primvar
    int mode = 0;                   ///< whatever a string or uniform input selects
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
    const uint16_t* inputs; ///< register of each input of the node definition but texts
    uint16_t output;        ///< register of the first output, further ones follow
    const PatternData& data;
    const PatternContext& context;

    const glm::vec4& in(int i) const { return registers[inputs[i]]; }
    float x(int i) const { return registers[inputs[i]].x; }
    glm::vec4& out(int i = 0) const { return registers[output + i]; }
    const glm::vec4& row(int i, int k) const { return registers[inputs[i] + k]; } ///< of a matrix
    const ShadingPoint& point() const { return *context.point; }
    /// The primvar of the node; components that it lacks are those of the fallback.
    glm::vec4 primvar(glm::vec4 fallback) const {
        if (data.slot >= 0 && context.point->primvars)
            context.point->primvars->read(data.slot, &fallback.x);
        return fallback;
    }
};

using PatternFunction = void (*)(const PatternCall& call);

/// What a parameter of a pattern's function takes, or what it gives.
enum class PatternType : uint8_t {
    None,
    Float,
    Int,
    Bool,
    Vec2,
    Vec3,
    Vec4,
    Mat3,
    Mat4,
    Primvar, ///< of the node, or its next input where there is none
    // No inputs of the node; shaders/compat/nodes.glsl has their names.
    PrimvarOrZero,
    PrimvarOrBlack,
    Size,
    Mode,
    Texture,
    Wavelength,
    Point
};

/// Registers that a value takes: a matrix has one for each row.
constexpr int patternRows(PatternType type) {
    return type == PatternType::None   ? 0
           : type == PatternType::Mat3 ? 3
           : type == PatternType::Mat4 ? 4
                                       : 1;
}

struct PatternParameter {
    PatternType type;
    bool output;

    constexpr bool isInput() const { return !output && type <= PatternType::Primvar; }
};

/// The computation of a node, for both back ends: a function of the shader dialect, as the compiler
/// sees it. PATINA_PATTERN() makes it (patternFunctions.h); rows of nodes hold it.
struct Pattern {
    constexpr Pattern(std::nullptr_t = nullptr) {}

    PatternFunction function = nullptr;
    const char* name = nullptr; ///< of the function
    const char* file = nullptr; ///< of shaders/patterns/nodes, where it is
    const PatternParameter* parameters = nullptr;
    int parameterCount = 0;
    PatternType result = PatternType::None; ///< the first output, else that is a parameter

    constexpr bool takes(PatternType type) const {
        for (int i = 0; i < parameterCount; ++i)
            if (parameters[i].type == type) return true;
        return false;
    }
    /// Has other values for each wavelength.
    constexpr bool spectral() const { return takes(PatternType::Wavelength); }
    /// Reads the shading point, so that it cannot be folded.
    constexpr bool varies() const {
        for (int i = 0; i < parameterCount; ++i)
            if (parameters[i].type >= PatternType::Primvar &&
                parameters[i].type != PatternType::Size)
                return true;
        return false;
    }
    /// Registers of all outputs.
    constexpr int outputRows() const {
        int n = patternRows(result);
        for (int i = 0; i < parameterCount; ++i)
            n += parameters[i].output ? patternRows(parameters[i].type) : 0;
        return n;
    }
};

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
    virtual void warn(const char* input, const Message& what) = 0;

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
