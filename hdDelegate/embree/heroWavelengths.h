// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/wavelengths.h"
#include "materialNetwork/cpu/materialProgram.h"
#include "hdDelegate/scene/types.h"

namespace patina {

/// The wavelengths that a path is followed for, once it has met a material that disperses (Wilkie
/// et al. 2014, Hero Wavelength Spectral Sampling). The first, the hero, chooses directions; the
/// others weigh them by the balance heuristic. docs/design/pathTracer.md has the equations.
struct HeroWavelengths {
    static constexpr int count = 3;

    float nm[count] = {}; ///< 0 until begin()
    vec3 shares[count];   ///< of the path's throughput, per channel; they sum to 1
    float chances[count]; ///< of the path so far, had this one been the hero; their mean is 1
    bool alone = false;   ///< the hero is the only one left

    bool chosen() const { return nm[0] > 0.0f; }

    /// Chooses all, evenly apart in what channels see. @param u in [0, 1)
    /// @returns the factor on the path's throughput
    vec3 begin(float u, const Wavelengths& wavelengths = Wavelengths::of());

    /// Goes on with the hero alone. @returns the factor on the path's throughput
    vec3 leaveOthers();
};

/// The lobes of a point for each of a path's wavelengths.
class DispersedBsdf {
public:
    /// @param point with the hero's wavelength
    /// @param hero the lobes there, which must outlive this
    DispersedBsdf(const MaterialProgram& program, const ShadingPoint& point,
                  const HeroWavelengths& waves, const Bsdf& hero);

    bool transmits() const { return _transmits; }   ///< any of them
    bool hasNonDelta() const { return _nonDelta; }  ///< any of them
    bool stochastic() const { return _stochastic; } ///< any of them

    /// @returns value of all, each by its share; the density is that of sample()
    BsdfEval eval(const vec3& wi) const;

    /// Draws from the hero's lobes; the weight is that of all wavelengths.
    /// @param after gets what they are behind the vertex
    BsdfSample sample(const vec3& u, float uLobe, HeroWavelengths& after) const;

private:
    const Bsdf& at(int i) const { return i == 0 ? _hero : _others[i - 1]; }

    const HeroWavelengths _waves;
    const Bsdf& _hero;
    Bsdf _others[HeroWavelengths::count - 1];
    bool _transmits, _nonDelta, _stochastic;
};

/// The lobes of a vertex, as light that comes to it or leaves it evaluates them.
class VertexBsdf {
public:
    /// @param dispersed the same point for several wavelengths, or null
    VertexBsdf(const Bsdf& bsdf, const DispersedBsdf* dispersed = nullptr)
        : _bsdf(bsdf), _dispersed(dispersed) {}

    BsdfEval eval(const vec3& wi) const {
        return _dispersed ? _dispersed->eval(wi) : _bsdf.eval(wi);
    }
    BsdfEval evalDrawn(const BsdfSample& sample) const {
        return _dispersed ? _dispersed->eval(sample.wi) : _bsdf.evalDrawn(sample);
    }
    bool transmits() const { return _dispersed ? _dispersed->transmits() : _bsdf.transmits(); }
    bool hasNonDelta() const {
        return _dispersed ? _dispersed->hasNonDelta() : _bsdf.hasNonDelta();
    }
    float ior() const { return _bsdf.ior(); }  ///< the hero's
    const Bsdf& bsdf() const { return _bsdf; } ///< likewise
    BsdfSample sample(const vec4& u, HeroWavelengths& waves) const {
        return _dispersed ? _dispersed->sample(vec3(u), u.w, waves) : _bsdf.sample(vec3(u), u.w);
    }

private:
    const Bsdf& _bsdf;
    const DispersedBsdf* _dispersed;
};

} // namespace patina
