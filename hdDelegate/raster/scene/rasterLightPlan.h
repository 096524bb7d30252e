// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/raster/scene/rasterInstances.h"
#include "hdDelegate/scene/light.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"
#include "materialNetwork/plan/methodPlan.h"

#include <set>

namespace patina {

/// Share of a sky's light that comes from its brightest hundredth: 0.01 of an even one, nearly all
/// of a small sun.
double peakShare(const EnvironmentMap& map);

/// Chooses, for a scene's lights, how materials are lit by domes (`domeLight`,
/// `environmentSamples`) and by areas (`areaLight`).
///
/// Samples converge. Their cost is the time of as many passes as their noise needs to fall to its
/// share of the tolerance. A method without noise costs the fewest possible passes. Its error has
/// to fit into the rest of methodShare of the tolerance that the material's own methods leave. The
/// faster one is taken. A dome is looked up between the measured skies by its peakShare().
class RasterLightPlan {
public:
    /// peakShare() of the skies that rows are of (hdDelegate/raster/measure/measuredSky).
    static constexpr double evenPeak = 0.01, softPeak = 0.05, sunPeak = 0.83;

    /// Of all lights of a scene. Without a tolerance the planner looks at none.
    static RasterLightPlan of(const SceneState& state, const RenderSettings& settings,
                              RasterInstances& places, LightImages& images);

    void addDome(const EnvironmentMap* map); ///< null: the same from everywhere
    void addArea(const Light& light);
    /// Some light has filters, which programs then take in.
    void needFilters() { _needsFilters = true; }
    bool needsFilters() const { return _needsFilters; }
    /// There are so many lights that pixels choose among them, which programs then can do.
    void needChoice() { _needsChoice = true; }
    bool needsChoice() const { return _needsChoice; }
    /// What programs that choose among lights begin with: facts that hold for all lights, so that
    /// software OpenGL need not run code for what there is none of.
    std::string text() const;
    /// Volumes and what transmits look at samples of domes, and so does what filters change:
    /// nothing else may be chosen.
    void needSamples() { _needsSamples = true; }

    /// @param material as planned, without walks
    /// @param transmits see needSamples()
    /// @returns the choices that matter to it; none where nothing is planned
    std::vector<PlannedMethod> choose(const MethodPlan& material, const RenderSettings& settings,
                                      bool transmits) const;

private:
    struct Option {
        std::string method;
        int samples = 0; ///< of environmentSamples
        double error = 0.0, ns = 0.0;
    };
    Option domes(const MethodPlan& material, const RenderSettings& settings,
                 const std::string& method, int samples) const;
    Option areas(const MethodPlan& material, const std::string& method, bool& measured) const;

    double _peak = 0.0;
    bool _hasDome = false, _needsSamples = false, _needsFilters = false, _needsChoice = false;
    bool _images = false, _profiles = false, _sky = false, _fades = false; ///< some light has
    std::set<std::string> _areas; ///< the shapes, as rows name them
};

} // namespace patina
