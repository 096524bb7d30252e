// SPDX-License-Identifier: Apache-2.0
#pragma once

// Patterns made of functions of the shader dialect, and the C++ side of shaders/compat/nodes.glsl.
// Before it, a file of nodes says where their functions are:
//     #define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/color.glsl"
// and includes that file once more with PATINA_NODE_ROWS, for the rows behind them.
// PATINA_PATTERN(nodeX) then is the pattern of a function there. One whose name begins otherwise is
// in shaders/patterns.glsl, which every text has. Its parameters are the inputs of the node in
// their order, without strings, and whatever else of shaders/compat/nodes.glsl it asks for. What
// it returns is the first output; PATINA_OUT parameters are the further ones.

#include "materialNetwork/nodes/pattern.h"

#include "shaders/patterns.h"

#include <string_view>
#include <tuple>
#include <utility>

#define PATINA_FN inline
#define PATINA_FN_RARE [[gnu::noinline]] inline
#define PATINA_IN(T) const T&
#define PATINA_OUT(T) T&
#define PATINA_UNUSED(T, name) T

namespace patina {
namespace sh {

using SurfacePoint = ShadingPoint;

inline vec3 viewOf(const SurfacePoint& p) {
    return p.viewDirection;
}
inline vec3 worldPositionOf(const SurfacePoint& p) {
    return p.worldPosition();
}

template <class T, PatternType> struct NodeFact {
    T value;
    operator T() const { return value; }
};
using NodeSize = NodeFact<int, PatternType::Size>;
using NodeMode = NodeFact<int, PatternType::Mode>;
using NodeWavelength = NodeFact<float, PatternType::Wavelength>;

template <PatternType> struct NodePrimvarOr : vec4 {
    explicit NodePrimvarOr(const vec4& v) : vec4(v) {}
};
using NodePrimvar = NodePrimvarOr<PatternType::Primvar>;
using NodePrimvarOrZero = NodePrimvarOr<PatternType::PrimvarOrZero>;
using NodePrimvarOrBlack = NodePrimvarOr<PatternType::PrimvarOrBlack>;

struct NodeTexture {
    const TextureSource* source;
    int handle;
};
inline bool hasTexture(const NodeTexture& texture) {
    return texture.handle >= 0;
}
inline vec4 texel(const NodeTexture& texture, const vec2& uv, float footprint) {
    return texture.source->sample(texture.handle, uv, footprint);
}

// Nothing beyond the file needs them by name, so that each is compiled into its pattern.
namespace {
// In floats alone, so that vectors have glm's own functions.
using glm::cross;
using glm::dot;
using glm::length;
using glm::operator*;
using glm::operator/;
#include PATINA_NODE_FUNCTIONS
} // namespace

} // namespace sh

/// What a call gives a parameter of type T. input: its place among the inputs; texture: among the
/// textures.
template <class T> struct PatternArgument;

#define PATINA_ARGUMENT(T, kind, ...)                                                              \
    template <> struct PatternArgument<T> {                                                        \
        static constexpr PatternType type = PatternType::kind;                                     \
        static T read(const PatternCall& c, [[maybe_unused]] int input,                            \
                      [[maybe_unused]] int texture) {                                              \
            return __VA_ARGS__;                                                                    \
        }                                                                                          \
    };
PATINA_ARGUMENT(float, Float, c.x(input))
PATINA_ARGUMENT(int, Int, sh::patternWhole(c.x(input)))
PATINA_ARGUMENT(bool, Bool, c.x(input) != 0.0f)
PATINA_ARGUMENT(sh::vec2, Vec2, sh::vec2(c.in(input)))
PATINA_ARGUMENT(sh::vec3, Vec3, sh::vec3(c.in(input)))
PATINA_ARGUMENT(sh::vec4, Vec4, c.in(input))
PATINA_ARGUMENT(sh::mat3, Mat3,
                sh::mat3(sh::vec3(c.row(input, 0)), sh::vec3(c.row(input, 1)),
                         sh::vec3(c.row(input, 2))))
PATINA_ARGUMENT(sh::mat4, Mat4,
                sh::mat4(c.row(input, 0), c.row(input, 1), c.row(input, 2), c.row(input, 3)))
PATINA_ARGUMENT(sh::NodeSize, Size, {c.data.size})
PATINA_ARGUMENT(sh::NodeMode, Mode, {c.data.mode})
PATINA_ARGUMENT(sh::NodeWavelength, Wavelength, {c.point().wavelength})
PATINA_ARGUMENT(sh::NodePrimvar, Primvar, sh::NodePrimvar(c.primvar(c.in(input))))
PATINA_ARGUMENT(sh::NodePrimvarOrZero, PrimvarOrZero,
                sh::NodePrimvarOrZero(c.primvar(sh::vec4(0.0f))))
PATINA_ARGUMENT(sh::NodePrimvarOrBlack, PrimvarOrBlack,
                sh::NodePrimvarOrBlack(c.primvar(sh::vec4(0.0f, 0.0f, 0.0f, 1.0f))))
PATINA_ARGUMENT(sh::NodeTexture, Texture, {c.context.textures, c.data.textures[texture]})
#undef PATINA_ARGUMENT
template <> struct PatternArgument<const sh::SurfacePoint&> {
    static constexpr PatternType type = PatternType::Point;
    static const ShadingPoint& read(const PatternCall& c, int, int) { return c.point(); }
};
/// A further output.
template <class T> struct PatternArgument<T&> {
    static constexpr PatternType type = PatternArgument<T>::type;
    static T read(const PatternCall&, int, int) { return T(); }
};
template <> struct PatternArgument<void> { static constexpr PatternType type = PatternType::None; };

template <class T> constexpr bool isPatternOutput =
    std::is_lvalue_reference_v<T> && !std::is_const_v<std::remove_reference_t<T>>;

/// What holds a value for a parameter of type T.
template <class T> using PatternHeld =
    std::conditional_t<isPatternOutput<T>, std::remove_reference_t<T>, T>;

/// Writes an output; a scalar fills its register.
template <class T> void storeOutput(const PatternCall& c, int row, const T& value) {
    constexpr PatternType type = PatternArgument<T>::type;
    if constexpr (type == PatternType::Vec2)
        c.out(row) = sh::vec4(value, 0.0f, 0.0f);
    else if constexpr (type == PatternType::Vec3)
        c.out(row) = sh::vec4(value, 0.0f);
    else if constexpr (type == PatternType::Vec4)
        c.out(row) = value;
    else if constexpr (type == PatternType::Mat3)
        for (int i = 0; i < 3; ++i)
            c.out(row + i) = sh::vec4(value[i], 0.0f);
    else if constexpr (type == PatternType::Mat4)
        for (int i = 0; i < 4; ++i)
            c.out(row + i) = value[i];
    else
        c.out(row) = sh::vec4(float(value));
}

/// The pattern of a function.
template <auto Function> struct PatternOf;
template <class Result, class... P, Result (*Function)(P...)> struct PatternOf<Function> {
    static constexpr int count = int(sizeof...(P));
    static constexpr PatternParameter parameters[count + 1] = {
        {PatternArgument<P>::type, isPatternOutput<P>}..., {PatternType::None, false}};
    static constexpr PatternType result = PatternArgument<Result>::type;

    static constexpr int inputBefore(int parameter) {
        int n = 0;
        for (int i = 0; i < parameter; ++i)
            n += parameters[i].isInput();
        return n;
    }
    static constexpr int textureBefore(int parameter) {
        int n = 0;
        for (int i = 0; i < parameter; ++i)
            n += parameters[i].type == PatternType::Texture;
        return n;
    }
    static constexpr int rowBefore(int parameter) {
        int n = patternRows(result);
        for (int i = 0; i < parameter; ++i)
            n += parameters[i].output ? patternRows(parameters[i].type) : 0;
        return n;
    }

    static void run(const PatternCall& c) { call(c, std::index_sequence_for<P...>()); }

    template <size_t... I> static void call(const PatternCall& c, std::index_sequence<I...>) {
        if constexpr ((isPatternOutput<P> || ...)) {
            std::tuple<PatternHeld<P>...> values(
                PatternArgument<P>::read(c, inputBefore(I), textureBefore(I))...);
            if constexpr (result == PatternType::None)
                Function(std::get<I>(values)...);
            else
                storeOutput(c, 0, Function(std::get<I>(values)...));
            (
                [&] {
                    if constexpr (isPatternOutput<P>)
                        storeOutput(c, rowBefore(int(I)), std::get<I>(values));
                }(),
                ...);
        } else {
            storeOutput(c, 0,
                        Function(PatternArgument<P>::read(c, inputBefore(I), textureBefore(I))...));
        }
    }

    static constexpr Pattern named(std::string_view name, const char* file) {
        Pattern pattern;
        pattern.function = run;
        pattern.name = name.data();
        pattern.file = name.substr(0, 4) == "node" ? file : nullptr;
        pattern.parameters = parameters;
        pattern.parameterCount = count;
        pattern.result = result;
        return pattern;
    }
};

#define PATINA_PATTERN(function) PatternOf<&sh::function>::named(#function, PATINA_NODE_FUNCTIONS)

} // namespace patina
