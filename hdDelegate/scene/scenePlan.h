#pragma once

#include "materialNetwork/planner.h"

#include <map>
#include <string>

namespace patina {

/// What the methods of a scene's materials mean for an image of it: both back ends fill one when
/// they have compiled the materials, and stop sampling by what it leaves for noise.
class ScenePlan {
public:
    /// @param path of the material; empty for displayColor
    void add(const std::string& path, const MethodPlan& material);

    /// Relative luminance error that methods are expected to cost: that of the material where it
    /// is largest, since it may fill the image.
    double error() const { return _error; }

    /// Vertices of a path that a tolerance needs: what light has left after so many surfaces as
    /// white as the whitest is at most depthShare of the tolerance; 0 of it: depthMost; negative:
    /// depthStandard. Roulette has no part in this, since it makes noise alone.
    int depth(double tolerance) const;

    static constexpr int depthStandard = 16, depthLeast = 4, depthMost = 1024;

    /// What noise may take of a tolerance: all that methods and depth leave, and never less than
    /// their own shares leave (methods that are forced may spoil more). 0 and below: all samples.
    double noise(double tolerance) const;

    /// For RenderProgress::statistics; nothing without a tolerance.
    void tell(double tolerance, std::map<std::string, double>& statistics) const;

    /// Of every material in use, by its path.
    const std::map<std::string, MethodPlan>& materials() const { return _materials; }

private:
    double _error = 0.0, _albedo = 0.0;
    std::map<std::string, MethodPlan> _materials;
};

} // namespace patina
