// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/settings.h"
#include "materialNetwork/planner/planner.h"

#include <map>
#include <string>

namespace patina {

/// Methods of a scene and of its materials, and their expected effect on an image of it: both back
/// ends fill one when they have compiled the materials, and stop sampling by what it leaves for
/// noise.
class ScenePlan {
public:
    /// @param path of the material; empty for displayColor
    void add(const std::string& path, const MethodPlan& material);
    /// A choice that holds for all of the scene; one without a name is none.
    void add(const PlannedMethod& choice);
    /// Adds what a path tracer chooses: pathDepth and roulette.
    void addPaths(const RenderSettings& settings);

    /// Relative luminance error that methods are expected to cost: that of the material where it
    /// is largest, since it may fill the image.
    double error() const { return _error; }

    /// Vertices of a path: those of the settings or of a forced method, else by the tolerance. The
    /// light left after so many surfaces, as white as the whitest, is at most depthShare of it. 0:
    /// maxPlannedDepth; negative: depthStandard. Roulette has no part in this, since it
    /// makes noise alone.
    int depth(const RenderSettings& settings) const;
    /// RenderSettings::rouletteDepth, beyond all depths where the method is `none`.
    int rouletteDepth(const RenderSettings& settings) const;

    static constexpr int depthStandard = 16, maxPlannedDepth = 1024;

    /// The part of a tolerance that noise may take: what the predicted errors of methods, edges and
    /// paths leave (noiseBeside), and never less than their shares leave (methods that are forced
    /// may spoil more). 0 and below: all samples.
    double noise(double tolerance) const;

    /// For RenderProgress::statistics; nothing without a tolerance.
    void addStatistics(double tolerance, std::map<std::string, double>& statistics) const;

    /// Of every material in use, by its path.
    const std::map<std::string, MethodPlan>& materials() const { return _materials; }
    /// Choices of the scene as a whole; times are over those of the default.
    const std::vector<PlannedMethod>& choices() const { return _choices; }

private:
    PlannedMethod pathDepth(const RenderSettings& settings) const;
    PlannedMethod roulette(const RenderSettings& settings) const;

    double _error = 0.0, _albedo = 0.0, _subdivision = 0.0, _depth = 0.0;
    std::map<std::string, MethodPlan> _materials;
    std::vector<PlannedMethod> _choices;
};

} // namespace patina
