// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <functional>

namespace patina {

/// How much a path does at the first rough surface that the camera sees, straight or by way of
/// mirrors and clear glass. The way there is paid for already, so it may pay to take several light
/// samples and to go on several times (Arvo and Kirk 1990, Particle transport and image synthesis).
struct Splitting {
    static constexpr int mostLightSamples = 8, mostBranches = 4; ///< that are chosen

    int lightSamples = 1, branches = 1;
};

/// What a path collects and spends between its steps, where it takes two light samples and goes on
/// twice. Steps that it does not take collect nothing.
class SplitProbe {
public:
    static constexpr Splitting splitting{2, 2};
    enum Step { LightSample, SecondLightSample, Between, Branch, SecondBranch, End };

    /// A step begins. @param cost until then, of TraceCounters
    void begin(int step, const vec3& radiance, float cost);
    /// No step follows.
    void end(const vec3& radiance, float cost);

    vec3 color() const { return _radiance[End]; }
    float cost() const { return _cost[End]; }
    vec3 radiance(int step) const { return _radiance[step + 1] - _radiance[step]; }
    float cost(int step) const { return _cost[step + 1] - _cost[step]; }

private:
    bool _begun[End] = {};
    vec3 _radiance[End + 1] = {};
    float _cost[End + 1] = {};
};

/// The numbers of light samples and of branches, powers of two, with the least product of time and
/// variance over some pixels (after Bolin and Meyer 1997). Time is counted in rays, so that all
/// machines choose alike.
/// @param width,height of the image; it depends on nothing else but the probes
/// @param wanted numbers that are fixed; 0: to be chosen
/// @param probe of a sample of a pixel; called by many threads
Splitting chooseSplitting(int width, int height, const Splitting& wanted,
                          const std::function<SplitProbe(int x, int y, uint32_t index)>& probe);

} // namespace patina
