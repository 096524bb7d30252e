// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/pattern.h"
#include "materialNetwork/lobes.h"
#include "materialNetwork/network/network.h"

#include <string>
#include <vector>

namespace patina {

/// The kinds of nodes that are not patterns.
enum class ClosureKind {
    None, ///< a pattern
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) Kind,
#include "materialNetwork/lobeTable.inc"
    ThinFilm, ///< MaterialX 1.38: as the top of a layer it coats the base
    UniformEdf,
    ConicalEdf,
    MeasuredEdf, ///< by an IES profile
    SchlickEdf,  ///< a factor on its base
    AbsorptionVdf,
    AnisotropicVdf,
    Layer, ///< (top, base)
    Mix,   ///< (fg, bg, mix)
    Add,
    Multiply,
    ThinSlab, ///< its closure belongs to a surface without an inside
    Surface,
    SurfaceUnlit,
    Volume,
    Material,
    Displacement,
    Unsupported ///< known by name and inputs; renders as nothing, with a warning
};

constexpr bool isLobe(ClosureKind kind) {
    return kind > ClosureKind::None && kind < ClosureKind::ThinFilm;
}
/// @param kind of a lobe
constexpr LobeKind lobeKind(ClosureKind kind) {
    return LobeKind(int(kind) - int(ClosureKind::None) - 1);
}
/// False of what is no lobe.
constexpr bool lobeHas(ClosureKind kind, lobe::Trait trait) {
    return isLobe(kind) && lobeHas(lobeKind(kind), trait);
}

struct InputDef {
    std::string name;
    ValueType type = ValueType::Unknown;
    Value value;             ///< default; empty for closures
    std::string geomprop;    ///< default taken from the geometry: "Nworld", "Tworld", "UV0"...
    std::string notModelled; ///< what values other than the default ask for in vain; mostly empty
    /// Names that stand for numbers when a string is authored on a numeric input.
    std::vector<std::string> enumNames;
    std::vector<float> enumValues;
    std::vector<std::string> words; ///< a string's choices; the first stands in for any other text
};

struct OutputDef {
    std::string name;
    ValueType type = ValueType::Unknown;
};

/// How simplify() may replace a node beyond folding it: each is the algebra of one node.
enum class Algebra {
    None,
    Alias,     ///< output is input 0 (dot, constant)
    Add,       ///< 0 is neutral
    Subtract,  ///< a 0 on the right is neutral
    Multiply,  ///< 1 is neutral, 0 absorbs
    Divide,    ///< a 1 on the right is neutral
    Mix,       ///< (fg, bg, mix) at mix 0 and 1
    IfGreater, ///< (value1, value2, in1, in2)
    IfGreaterEq,
    IfEqual,
    Switch,    ///< (in1.., which)
    Rotate,    ///< (in, amount...) by nothing
    NormalMap, ///< (in, scale, normal...) with a neutral colour
    Disperse,  ///< (ior, abbe number, scale): at number or scale 0 the ior
    IsUniform  ///< 1 when the input is the same everywhere, else 0
};

/// One node definition: a row of the table.
struct NodeDef {
    std::string id;       ///< "ND_add_color3"
    std::string category; ///< "add"
    std::vector<InputDef> inputs;
    std::vector<OutputDef> outputs;
    ClosureKind closure = ClosureKind::None;
    const Pattern* pattern = nullptr; ///< null for closures, and for strings
    PatternPrepare prepare = nullptr; ///< reads strings, opens textures, asks for primvars
    bool varying = false;             ///< reads the shading point or is prepared: never folded
    Algebra algebra = Algebra::None;

    int findInput(const std::string& name) const;  ///< -1 when there is none
    int findOutput(const std::string& name) const; ///< "" finds the first; -1 when there is none
};

/// A type without a register.
bool isTextType(ValueType type);
/// A closure or shader type: not a number, not a string.
bool isClosureType(ValueType type);

/// Place of a text among an input's words; 0 where it is none of them.
int wordIndex(const InputDef& input, const std::string& text);

} // namespace patina
