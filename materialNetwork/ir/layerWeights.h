// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/bindMethods.h"
#include "materialNetwork/ir/closureTree.h"

// The weights of lobes, computed from the tree of closures around them, for both back ends (see
// closureTree.h). `Out` also provides:
//   coverage(lobe)        the share that a lobe takes from the base of a layer
//   setWeight(lobe, w)    receives the result
//   walks(op)             whether a layer is computed by a random walk
//   setWalked(w, op)      receives the weight of such a layer, in place of its parts
// and, for layers that count the light which their tops send back down:
//   albedo(lobe), kinds(lobe), inside(lobe), alpha(lobe), cosine(lobe)   arguments of the
//                         functions in closure/layers.glsl
//   meets(share)          whether a lobe of this share can be present

namespace patina {

/// One number or three for what a lobe takes from a base. @param c what lobeFix() says
template <class Out>
typename Out::Color coverOf(LayerTransmittance method, const typename Out::Color& c, Out& out) {
    switch (method) {
    case LayerTransmittance::PerChannel: break;
    case LayerTransmittance::Largest: return PATINA_CLOSURE(out, shareLargest, c);
    case LayerTransmittance::Average: return PATINA_CLOSURE(out, shareAverage, c);
    case LayerTransmittance::Tinted: break;
    }
    return PATINA_CLOSURE(out, unitColor, c);
}

/// Weights where tops take from their bases, as albedo scaling means it.
template <class Out> struct PlainLayers {
    using Color = typename Out::Color;
    using Number = typename Out::Number;
    using Light = Color;
    static constexpr const char* type = "vec3";

    const MaterialIr& code;
    Out& out;
    typename Out::template List<Color, 0> passes; ///< what the closures in tops let through

    PlainLayers(const MaterialIr& c, int root, Out& o) : code(c), out(o), passes(size_t(root) + 2) {
        for (int i = 0; i <= root; ++i)
            if (code.bsdf[size_t(i)].needsTransmittance)
                passes[i] = out.named(type, transmitted(i, code.bsdf[size_t(i)]));
    }

    bool reaches(const ClosureOp&) const { return true; }
    Light none() const { return out.grey(0.0f); }
    Light all() const { return out.grey(1.0f); }
    Light sum(const Light& a, const Light& b) { return PATINA_CLOSURE(out, closureSum, a, b); }
    Light scaled(const Light& a, const Number& x) {
        return PATINA_CLOSURE(out, closureScaled, a, x);
    }
    Light rest(const Light& a, const Number& x) { return PATINA_CLOSURE(out, closureRest, a, x); }
    Light tinted(const Light& a, const Color& c) {
        return PATINA_CLOSURE(out, closureTinted, a, c);
    }
    Light beneath(const Light& a, int, const ClosureOp& op) {
        return PATINA_CLOSURE(out, closureProduct, a, passesOf(op.a));
    }
    Color weight(const Light& a, const ClosureOp&, const Number& share) { return scaled(a, share); }

private:
    Color passesOf(int i) { return i < 0 ? out.grey(1.0f) : passes[i]; }

    Color transmitted(int i, const ClosureOp& op) {
        switch (op.kind) {
        case ClosureKind::Layer:
            return PATINA_CLOSURE(out, closureProduct, passesOf(op.a), passesOf(op.b));
        case ClosureKind::Mix:
            return PATINA_CLOSURE(out, closureMix, passesOf(op.a), passesOf(op.b),
                                  out.share(i, op));
        case ClosureKind::Add:
            return PATINA_CLOSURE(out, passBeside, passesOf(op.a), passesOf(op.b));
        case ClosureKind::Multiply: {
            // A factor tints the top alone.
            const LayerTransmittance method = code.layerTransmittance;
            const Color cover = coverOf(
                method == LayerTransmittance::PerChannel ? LayerTransmittance::Largest : method,
                out.factor(i, op), out);
            return PATINA_CLOSURE(out, passCovered, passesOf(op.a), cover);
        }
        default: break;
        }
        if (op.lobe < 0) return out.grey(1.0f);
        return PATINA_CLOSURE(out, passLobe, out.coverage(op.lobe), out.share(i, op));
    }
};

/// Weights where layers count what their tops send back down, as `returned` means it:
/// closure/layers.glsl.
template <class Out> struct ReturnedLayers {
    using Color = typename Out::Color;
    using Number = typename Out::Number;
    using Light = typename Out::Light;
    static constexpr const char* type = "LayerLight";

    const MaterialIr& code;
    Out& out;
    const uint32_t part;                           ///< lobes below the root
    typename Out::template List<Light, 0> light;   ///< what closures in bases reflect and pass
    typename Out::template List<Light, 1> through; ///< what reaches the bases of layers

    ReturnedLayers(const MaterialIr& c, int root, Out& o)
        : code(c), out(o), part(c.bsdf[size_t(root)].lobes), light(size_t(root) + 2),
          through(size_t(root) + 2) {
        for (int i = 0; i <= root; ++i) {
            const ClosureOp& op = code.bsdf[size_t(i)];
            if (!reaches(op)) {
                if (op.beneath) light[i] = none();
                continue;
            }
            if (op.kind == ClosureKind::Layer)
                through[i] = transmitted(op.a, light[op.b], op.returns);
            if (op.beneath) light[i] = out.named(type, reflected(i, op));
        }
    }

    bool reaches(const ClosureOp& op) const { return op.lobes != 0 && (op.lobes & ~part) == 0; }
    Light even(float x) const { return PATINA_CLOSURE(out, layerEven, out.grey(x)); }
    Light none() const { return even(0.0f); }
    Light all() const { return even(1.0f); }
    Light sum(const Light& a, const Light& b) { return PATINA_CLOSURE(out, layerSum, a, b); }
    Light scaled(const Light& a, const Number& x) { return PATINA_CLOSURE(out, layerShare, a, x); }
    Light rest(const Light& a, const Number& x) { return PATINA_CLOSURE(out, layerRest, a, x); }
    Light tinted(const Light& a, const Color& c) { return PATINA_CLOSURE(out, layerTinted, a, c); }
    Light beneath(const Light& a, int i, const ClosureOp&) { return product(a, through[i]); }
    Color weight(const Light& a, const ClosureOp& op, const Number& share) {
        return PATINA_CLOSURE(out, closureScaled,
                              PATINA_CLOSURE(out, layerWeight, a, out.kinds(op.lobe)), share);
    }

private:
    Light lightOf(int i) { return i < 0 ? none() : light[i]; }
    Light product(const Light& a, const Light& b) {
        return PATINA_CLOSURE(out, layerProduct, a, b);
    }

    Light reflected(int i, const ClosureOp& op) {
        switch (op.kind) {
        case ClosureKind::Layer: return sum(lightOf(op.a), product(through[i], lightOf(op.b)));
        case ClosureKind::Mix:
            return PATINA_CLOSURE(out, layerMix, lightOf(op.a), lightOf(op.b), out.share(i, op));
        case ClosureKind::Add: return sum(lightOf(op.a), lightOf(op.b));
        case ClosureKind::Multiply: return tinted(lightOf(op.a), out.factor(i, op));
        default: break;
        }
        return PATINA_CLOSURE(
            out, layerOfLobe,
            PATINA_CLOSURE(out, closureScaled, out.albedo(op.lobe), out.share(i, op)),
            out.kinds(op.lobe));
    }

    /// The share that a top lets through. @param base albedo of what lies below; @param returns
    /// whether light comes back to it
    Light transmitted(int top, const Light& base, bool returns) {
        if (top < 0) return all();
        return out.named(type, transmittedBy(top, code.bsdf[size_t(top)], base, returns));
    }

    Light transmittedBy(int top, const ClosureOp& op, const Light& base, bool returns) {
        switch (op.kind) {
        case ClosureKind::Layer: {
            const Light lower = transmitted(op.b, base, returns);
            const Light below = out.named(type, sum(lightOf(op.b), product(lower, base)));
            return product(transmitted(op.a, below, returns), lower);
        }
        case ClosureKind::Mix: {
            const Light a = transmitted(op.a, base, returns), b = transmitted(op.b, base, returns);
            return PATINA_CLOSURE(out, layerMix, a, b, out.share(top, op));
        }
        case ClosureKind::Add: {
            const Light a = transmitted(op.a, base, returns), b = transmitted(op.b, base, returns);
            return PATINA_CLOSURE(out, layerBeside, a, b);
        }
        case ClosureKind::Multiply: {
            const Light a = transmitted(op.a, base, returns);
            const Color cover = PATINA_CLOSURE(out, shareLargest, out.factor(top, op));
            return PATINA_CLOSURE(out, layerCovered, a, cover);
        }
        default: break;
        }
        if (op.lobe < 0) return all();
        const Number share = out.share(top, op);
        const Color coverage = out.coverage(op.lobe);
        if (!returns || !out.meets(share) || !isReturning(code.lobes[size_t(op.lobe)]))
            return PATINA_CLOSURE(out, layerPast, share, coverage);
        return PATINA_CLOSURE(out, layerThrough, share, coverage, out.inside(op.lobe),
                              out.alpha(op.lobe), out.cosine(op.lobe), base);
    }
};

/// Downwards: a closure's weight is the sum over the wholes that it is part of.
template <class Layers, class Out>
void weighLobes(const MaterialIr& code, int root, Layers&& layers, Out& out) {
    using Light = typename std::decay_t<Layers>::Light;
    using Number = typename Out::Number;
    typename Out::template List<Light, 2> weight(size_t(root) + 2);
    for (int i = 0; i < root; ++i)
        weight[i] = layers.none();
    weight[root] = layers.all();
    for (int i = root; i >= 0; --i) {
        const ClosureOp& op = code.bsdf[size_t(i)];
        if (!layers.reaches(op)) continue;
        const Light w = weight[i];
        const auto give = [&](int to, const Light& what) {
            if (to >= 0) weight[to] = out.named(layers.type, layers.sum(weight[to], what));
        };
        switch (op.kind) {
        case ClosureKind::Layer:
            if (out.walks(op)) {
                // The top covers the base by its weight.
                const Number covers = out.share(op.a, code.bsdf[size_t(op.a)]);
                out.setWalked(w, covers, i);
                give(op.b, layers.rest(w, covers));
                break;
            }
            give(op.a, w);
            give(op.b, layers.beneath(w, i, op));
            break;
        case ClosureKind::Mix: {
            const Number share = out.share(i, op);
            give(op.a, layers.scaled(w, share));
            give(op.b, layers.rest(w, share));
            break;
        }
        case ClosureKind::Add:
            give(op.a, w);
            give(op.b, w);
            break;
        case ClosureKind::Multiply: give(op.a, layers.tinted(w, out.factor(i, op))); break;
        default:
            if (op.lobe >= 0) out.setWeight(op.lobe, layers.weight(w, op, out.share(i, op)));
        }
    }
}

/// The weights of all lobes below the root.
template <class Out> void weighLobes(const MaterialIr& code, int root, Out& out) {
    if (code.returnsLight)
        weighLobes(code, root, ReturnedLayers<Out>(code, root, out), out);
    else
        weighLobes(code, root, PlainLayers<Out>(code, root, out), out);
}

} // namespace patina
