// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"
#include "materialNetwork/ir/scratch.h"

#include "shaders/closure.h"

// Walks over trees of closures, written once for both back ends. The arithmetic of a step is a
// function of shaders/closure: where `Out` is ClosureNumbers it is called at a shading point, where
// it is ClosureText (glsl/) its call is written down.

namespace patina {

/// A call of a function of the dialect.
#define PATINA_CLOSURE(out, function, ...)                                                         \
    (out).call(                                                                                    \
        #function, [](const auto&... a) { return sh::function(a...); }, __VA_ARGS__)

/// Values of one shading point.
class ClosureNumbers {
public:
    using Number = float;
    using Color = glm::vec3;
    using Light = sh::LayerLight;
    /// Of each type and use only one may be alive per thread.
    template <class T, int use> using List = Scratch<T, use>;

    explicit ClosureNumbers(const glm::vec4* registers) : _registers(registers) {}

    Number number(Register r) const { return _registers[r].x; }
    Color color(Register r) const { return glm::vec3(_registers[r]); }
    static Color grey(float x) { return glm::vec3(x); }
    /// A share and a factor, as authored, of operation i.
    Number share(int, const ClosureOp& op) const { return sh::unit(number(op.factor)); }
    Color factor(int, const ClosureOp& op) const { return color(op.factor); }

    template <class F, class... A> static auto call(const char*, F f, const A&... a) {
        return f(a...);
    }
    template <class T> static const T& named(const char*, const T& value) { return value; }

private:
    const glm::vec4* _registers;
};

/// Value of a tree of EDFs, which are linear: sum of leaf values times factors.
/// @param out also says wo(), normal(), and factor of a profile about an axis
template <class Out> typename Out::Color emissionOf(const std::vector<ClosureOp>& ops, Out& out) {
    using Color = typename Out::Color;
    using Number = typename Out::Number;
    const int n = int(ops.size());
    typename Out::template List<Color, 0> value(size_t(n) + 1);
    const auto of = [&](int i) { return i < 0 ? out.grey(0.0f) : value[i]; };
    const auto axis = [&](const ClosureOp& op) {
        if (op.normal < 0) return out.normal();
        return PATINA_CLOSURE(out, unitOr, out.color(Register(op.normal)), out.normal());
    };
    for (int i = 0; i < n; ++i) {
        const ClosureOp& op = ops[size_t(i)];
        Color v = out.grey(0.0f);
        switch (op.kind) {
        case ClosureKind::Mix:
            v = PATINA_CLOSURE(out, closureMix, of(op.a), of(op.b), out.share(i, op));
            break;
        case ClosureKind::Add: v = PATINA_CLOSURE(out, closureSum, of(op.a), of(op.b)); break;
        case ClosureKind::Multiply:
            v = PATINA_CLOSURE(out, emissionTinted, of(op.a), out.factor(i, op));
            break;
        case ClosureKind::ConicalEdf: {
            const Color color = out.factor(i, op);
            const Number inner = out.number(op.first), outer = out.number(op.second);
            v = PATINA_CLOSURE(out, emissionConical, color, inner, outer, out.wo(), axis(op));
            break;
        }
        case ClosureKind::MeasuredEdf:
            v = out.factor(i, op);
            if (out.hasProfile(op))
                v = PATINA_CLOSURE(out, emissionScaled, v, out.profile(op, axis(op)));
            break;
        case ClosureKind::SchlickEdf: {
            const Color color0 = out.factor(i, op), color90 = out.color(op.first);
            const Number exponent = out.number(op.second);
            v = PATINA_CLOSURE(out, emissionSchlick, of(op.a), color0, color90, exponent, out.wo(),
                               out.normal());
            break;
        }
        default: v = out.factor(i, op);
        }
        value[i] = out.named("vec3", PATINA_CLOSURE(out, emitted, v));
    }
    return of(n - 1);
}

/// A tree of VDFs: @param out adds the leaves to its medium, each with its weight
template <class Out> void addMedia(const std::vector<ClosureOp>& ops, Out& out) {
    using Color = typename Out::Color;
    const int n = int(ops.size());
    typename Out::template List<Color, 0> weight(size_t(n) + 1);
    for (int i = 0; i < n; ++i)
        weight[i] = out.grey(i == n - 1 ? 1.0f : 0.0f);
    for (int i = n - 1; i >= 0; --i) {
        const ClosureOp& op = ops[size_t(i)];
        const Color w = weight[i];
        if (w == out.grey(0.0f)) continue;
        const auto give = [&](int part, const Color& what) {
            if (part >= 0)
                weight[part] =
                    out.named("vec3", PATINA_CLOSURE(out, closureSum, weight[part], what));
        };
        switch (op.kind) {
        case ClosureKind::Mix: {
            const auto share = out.share(i, op);
            give(op.a, PATINA_CLOSURE(out, closureScaled, w, share));
            give(op.b, PATINA_CLOSURE(out, closureRest, w, share));
            break;
        }
        case ClosureKind::Add:
            give(op.a, w);
            give(op.b, w);
            break;
        case ClosureKind::Multiply:
            give(op.a, PATINA_CLOSURE(out, closureProduct, w,
                                      PATINA_CLOSURE(out, coefficient, out.factor(i, op))));
            break;
        case ClosureKind::AnisotropicVdf: {
            const Color absorption = out.color(op.factor), scattering = out.color(op.scattering);
            out.addAnisotropic(w, absorption, scattering, out.number(op.anisotropy));
            break;
        }
        case ClosureKind::AbsorptionVdf: out.addAbsorption(w, out.color(op.factor)); break;
        default: break;
        }
    }
}

} // namespace patina
