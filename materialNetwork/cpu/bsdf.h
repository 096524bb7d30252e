// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/lobes.h"

#include "shaders/closure.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>

namespace patina {

/// Value of a whole material for two directions, and the density with which sample() finds wi.
/// The light inputs `diffuse` and `specular` scale its parts.
struct BsdfEval : sh::MaterialEval {
    BsdfEval() : sh::MaterialEval(sh::materialEvalNone()) {}
};

/// BsdfSample::event bit: light enters to be scattered beneath the surface, see SubsurfaceEntry.
constexpr int LOBE_SUBSURFACE = 8;

/// The medium beneath the surface. Light enters spread by the cosine (Lambert),
/// scatters, and leaves spread by the cosine again.
struct SubsurfaceEntry {
    glm::vec3 color{0.0f};  ///< albedo of an infinitely thick object under diffuse light
    glm::vec3 radius{0.0f}; ///< mean free path per channel, scene units
    float anisotropy = 0.0f;
};

/// What the lobes of a point send on by Lambert's law: albedo times irradiance over pi.
struct LambertPart {
    glm::vec3 reflected{0.0f}, transmitted{0.0f}; ///< albedos
    glm::vec3 normal{0.0f};                       ///< of these lobes, towards the viewer

    bool empty() const { return reflected + transmitted == glm::vec3(0.0f); }
};

struct LayeredPoint;

struct BsdfSample {
    glm::vec3 wi{0.0f};
    glm::vec3 weight{0.0f}; ///< f |cos| / pdf over all lobes (of the delta lobe alone when delta)
    float pdf = 0.0f;       ///< solid angle over all lobes; probability when delta
    int event = 0;          ///< LOBE_REFLECT, LOBE_TRANSMIT, LOBE_DELTA bits; 0: no sample
    bool diffuse = false;   ///< which kind of lobe was drawn
    bool alone = false;     ///< weight is of the lobe drawn alone; pdf is an estimate
    float eta = 1.0f;       ///< ior ratio crossed
    int lobe = -1;          ///< that was drawn
    float roughness = 0.0f; ///< GGX alpha of the lobe drawn (1 for diffuse), to widen the ray cone
};

/// A layer between whose top and base light is walked, see layerWalk.h.
struct LayeredLobe {
    int op; ///< of the program's BSDF
    bool transmits;
};

/// A leaf of the BSDF, ready for one shading point.
struct BsdfLobe {
    LobeKind kind;
    bool diffuse;      ///< counts as diffuse light (BsdfEval::diffuse)
    bool stochastic;   ///< its values are random, see Bsdf::stochastic()
    uint8_t frame;     ///< index into the frames of the Bsdf
    uint8_t place;     ///< in its program; a Bsdf leaves out lobes without weight
    float probability; ///< of being chosen by sample(); all sum to 1
    glm::vec3 weight;  ///< product of all weights, mixes and layers above it
    glm::vec3
        albedo; ///< directional albedo at wo without weight; an estimate unless a layer needs it
    union {
#define PATINA_LOBE(Kind, prefix, traits, probe, lit) sh::Kind##Lobe prefix;
#include "materialNetwork/lobeTable.inc"
        LayeredLobe layered;
    };
};

/// Shading frame of one or more lobes, in world space.
using BsdfFrame = sh::Frame;

/// The lobes of a material at one shading point: built by MaterialProgram, then asked many times.
/// Lives on the stack; no allocation, unless layers are walked. All directions are in world space
/// and point away from the surface; the outgoing direction is fixed when the Bsdf is built.
///
/// The geometric normal decides between reflection and transmission, together
/// with the lobe's own normal: where the two disagree the value is 0, so that no light leaks
/// through a surface because of an interpolated or mapped normal.
class Bsdf {
public:
    static constexpr int maxLobes =
        32; ///< two of the largest models; more are dropped, with a warning at compile time
    static constexpr int maxFrames = 16;

    Bsdf() {} // NOLINT: members are left uninitialised on purpose; evaluate() fills what is used

    /// @returns values and density of the non-delta lobes for wi
    BsdfEval eval(const glm::vec3& wi) const;

    /// Chooses a lobe in proportion to luminance(weight * albedo) and samples it.
    /// @param u for the direction; @param uLobe for the choice of the lobe; all in [0, 1)
    BsdfSample sample(const glm::vec3& u, float uLobe) const;

    /// @returns the ior over that of the surroundings, of the first lobe that refracts; 1 without
    /// one
    float ior() const;

    /// From now on subsurface lobes are events: eval() leaves them out, and sample() returns
    /// LOBE_SUBSURFACE with the inward normal as direction, and a weight without their colour.
    void walkSubsurface();
    /// @param sample one with LOBE_SUBSURFACE
    SubsurfaceEntry subsurface(const BsdfSample& sample) const;

    /// Makes this a white Lambert reflector of the normal.
    void makeDiffuse(const glm::vec3& normal, const glm::vec3& geometricNormal);

    /// Of Lambert lobes of one normal, without those of walkSubsurface(). Not where stochastic().
    LambertPart lambertPart() const;
    /// Takes out the lobes of lambertPart(). @returns the probability of those that are left
    float dropLambert();

    /// @returns directional albedo of the whole material at wo (reflection and transmission); an
    /// estimate by a few samples when stochastic()
    glm::vec3 albedo() const;

    /// @returns about albedo(), without noise: what lobes are chosen by
    glm::vec3 likelyAlbedo() const;

    /// @returns whether a lobe has no formula. Then eval() gives random values whose mean is right,
    ///     and densities that are never 0 where the value is not. Such a density may weigh
    ///     strategies against each other, but must not divide. sample() therefore keeps these lobes
    ///     apart: a sample of one has the weight of this lobe alone, a sample of any other lobe the
    ///     weight of all others. So nothing is divided by an estimate, and the mean over samples is
    ///     the mean over directions.
    bool stochastic() const { return _stochastic; }
    /// Other random values from now on. @param seed one per vertex of a path
    void seed(uint32_t seed) { _seed = seed; }

    /// @returns density of eval()
    float density(const glm::vec3& wi) const { return evalLobes(wi, Lobes::None).pdf; }

    /// @param lobes of the same point at another wavelength
    /// @param drawn a sample of these with LOBE_DELTA
    /// @param u that it was drawn with
    /// @returns value and probability of the same lobe here, in the measure of such a sample: its
    /// weight is value / pdf. 0 where it bends light another way, as its ior says: directions that
    /// were computed apart differ in their last bits.
    BsdfEval evalDelta(const Bsdf& lobes, const BsdfSample& drawn, const glm::vec3& u) const;

    /// @returns how the light that comes from `sample` counts: eval() of the lobes in its weight
    BsdfEval evalDrawn(const BsdfSample& sample) const;

    /// @returns false when eval() is 0 everywhere (mirrors, clear glass, black)
    bool hasNonDelta() const { return _nonDelta; }

    /// @returns true when a lobe sends light to the other side
    bool transmits() const { return _transmits; }

    bool empty() const { return _lobeCount == 0; }
    int lobeCount() const { return _lobeCount; }
    const BsdfLobe& lobe(int i) const { return _lobes[i]; }
    const BsdfFrame& frame(int i) const { return _frames[i]; }

private:
    friend class BsdfBuilder;

    enum class Lobes { All, Deterministic, None };
    BsdfEval evalLobes(const glm::vec3& wi, Lobes which) const;
    BsdfEval evalStochastic(int lobe, const glm::vec3& wi, const glm::vec3& local) const;
    float stochasticDensity(const BsdfLobe& lobe, const glm::vec3& wi,
                            const glm::vec3& local) const;
    BsdfSample sampleLobe(const BsdfLobe& lobe, const glm::vec3& u, glm::vec3& local) const;
    glm::vec3 sampledAlbedo() const;
    void preferWalks();
    bool walks(const BsdfLobe& lobe) const { return _walks && lobe.kind == LobeKind::Subsurface; }
    int lambertFrame() const;
    bool isLambert(const BsdfLobe& lobe) const;

    int _lobeCount = 0;
    bool _nonDelta = false;
    bool _transmits = false;
    bool _stochastic = false;
    bool _walks = false; ///< subsurface lobes are events
    uint32_t _seed = 0;
    bool _woOutside = true; ///< wo lies on the front side of the geometry
    glm::vec3 _geometricNormal;
    glm::vec3 _view; ///< towards the viewer; set where layers are walked
    std::shared_ptr<const LayeredPoint> _layers; ///< where layers are walked
    BsdfFrame _frames[maxFrames];
    BsdfLobe _lobes[maxLobes];
};

} // namespace patina
