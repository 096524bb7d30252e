// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/energyCurve.h"
#include "materialNetwork/lobes.h"
#include "materialNetwork/network/network.h"
#include "materialNetwork/nodes/nodeDef.h"
#include "materialNetwork/nodes/pattern.h"
#include "materialNetwork/plan/methods.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patina {

using Register = uint16_t;

struct Instruction {
    PatternFunction function; ///< the pattern's
    const Pattern* pattern;
    Register output;
    uint16_t inputCount;
    uint32_t firstInput; ///< into MaterialIr::inputPool
    PatternData data;
};

/// A lobe: its kind, where it stands, the registers of its parameters in the order of
/// lobeParameters(), and what is known at compile time.
struct LobeTemplate {
    static constexpr int maxParameters = 10;

    LobeKind kind = LobeKind::OrenNayar;
    bool diffuse = false; ///< counts as diffuse light
    uint8_t frame = 0;    ///< into MaterialIr::frames
    bool constant = false;
    bool flagA = false; ///< retroreflective, or energy_compensation
    bool sharedInterface = false;
    bool film = false;           ///< has a thin film
    bool filmDielectric = false; ///< a dielectric with a film: LobeKind::Schlick
    bool thin = false;           ///< of a thin slab
    bool passThrough = false;    ///< passes light straight on: part of the presence
    int mode = 0;                ///< SCATTER_*
    int variant = 0;             ///< lobeVariant()
    int ndf = 0;                 ///< microfacetDistribution()
    Register weight = 0;
    Register parameters[maxParameters] = {};

    // Set by bindMethods().
    MethodSet methods;
    int compensate = 1; ///< COMPENSATE_*
    bool walks = false; ///< between its facets, see cpu/microsurface.h

    /// Of constant interfaces, once a program for the processor has been made of the IR.
    EnergyCurve energy;
};

/// A closure of the plan with registers for operands. Parts come before wholes.
struct ClosureOp {
    ClosureKind kind = ClosureKind::None;
    int a = -1, b = -1;
    int lobe = -1;                   ///< index of the lobe, for lobes
    bool needsTransmittance = false; ///< stands somewhere in a layer's top
    bool darkensItself = false;      ///< a layer whose model says how much it takes from its base
    bool walkable = false;           ///< a layer between whose parts light can be walked
    bool walkableFlat = false;       ///< the same where no light goes beneath the surface
    uint32_t lobes = 0;              ///< that are part of it, a bit each
    Register factor = 0;             ///< lobe: weight; Mix: mix; Multiply: factor; EDF: value
                                     ////< VDF: absorption
    Register scattering = 0, anisotropy = 0; ///< of an AnisotropicVdf
    /// ConicalEdf: inner and outer angle. SchlickEdf: color90 and exponent (factor is color0).
    Register first = 0, second = 0;
    int normal = -1; ///< ConicalEdf, MeasuredEdf: its own normal, -1 for that of the point
    std::shared_ptr<const EmissionProfile> profile; ///< MeasuredEdf; null emits evenly

    // Set by bindMethods().
    bool walked = false;  ///< a layer that is walked, see cpu/layerWalk.h
    bool beneath = false; ///< stands somewhere in a layer's base, where light returns
    bool returns = false; ///< a layer whose top sends light back down that counts
};

struct FrameTemplate {
    int normal = -1, tangent = -1; ///< registers, -1 for the shading frame's own
    bool flips = true;             ///< turns to the viewer; false where the surface has an inside
    bool bends = true; ///< its normal is bent; false of lobes without a mirror direction
};

using method::LayerTransmittance;

/// A primvar that a material reads.
struct MaterialPrimvar {
    std::string name;
    ValueType type = ValueType::Float; ///< what the material wants; up to four components
};

/// Answers to the questions of hosts about a material, as MaterialProgram explains it.
struct MaterialFacts {
    std::vector<MaterialPrimvar> primvars;
    bool constant = false, hasEmission = false, isOpaque = true, isThinWalled = false;
    bool hasTransmission = false, isFibre = false, hasInterior = false, isVolumeOnly = false;
    bool hasSubsurface = false, hasDisplacement = false, passThroughEnters = false;
    bool usesUv = false, jitters = false;
    bool disperses = false;       ///< what it lets through bends by its wavelength
    bool heroWavelengths = false; ///< of which a path carries several at once
    /// The uv sets that tangents follow, of shading and of displacement.
    std::string tangentSet, displacementSet;
};

/// A compiled material that knows no back end: patterns as instructions over registers of four
/// floats, and the closures that these feed. Its methods are bound late (bindMethods), so that a
/// material is expanded and compiled once, whatever the planner then chooses. The processor runs it
/// (cpu/), and GLSL is written from it (glsl/).
struct MaterialIr {
    static constexpr int maxLobes = 32; ///< two of the largest models; more are dropped
    static constexpr int maxFrames = 16;

    std::vector<glm::vec4> constants; ///< the first registers
    int registerCount = 0;
    std::vector<Register> inputPool;
    std::vector<Instruction> opacityCode, emissionCode, interiorCode, surfaceCode, displacementCode;

    std::vector<ClosureOp> bsdf, edf, vdf, volumeEdf; ///< the last op is the root
    std::vector<LobeTemplate> lobes;
    std::vector<FrameTemplate> frames;
    Register zero = 0; ///< of a constant
    Register opacity = 0;
    Register displacement = 0, displacementScale = 0;
    bool displacementIsVector = false;
    bool hasPassThrough = false;      ///< a lobe passes light straight on
    bool opacityFromPrimvars = false; ///< only primvars can make opacity less than 1
    bool opacityIsOne = false;        ///< by itself, without what lobes pass straight on
    bool tooManyReturns = false; ///< what returns beneath a top would be asked for too many times
    const TextureSource* textures = nullptr;

    // Set by bindMethods(), with hasEmission and all else that follows from lobes.
    MaterialFacts facts;
    int walkedLayers = 0;          ///< of `bsdf`
    bool slabsHaveTwoFaces = true; ///< thin slabs
    LayerTransmittance layerTransmittance = LayerTransmittance::PerChannel;
    bool returnsLight = false; ///< a layer of `bsdf` returns light
};

/// Inputs of a lobe that are numbers, in the order of LobeTemplate::parameters.
const std::vector<std::string>& lobeParameters(LobeKind kind);
/// Its first boolean input, the flag of LobeTemplate; empty when there is none.
const std::string& lobeFlag(LobeKind kind);

} // namespace patina
