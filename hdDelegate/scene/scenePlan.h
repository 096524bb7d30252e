#pragma once

#include "materialNetwork/methodPlan.h"

#include <map>
#include <string>

namespace patina {

/// What the methods of a scene's materials mean for an image of it: both back ends fill one when
/// they have compiled the materials, and stop sampling by what it leaves for noise.
class ScenePlan {
public:
    void add(const MethodPlan& material);

    /// Relative luminance error that methods are expected to cost: that of the material where it
    /// is largest, since it may fill the image.
    double error() const { return _error; }

    /// What noise may take of a tolerance: all that methods leave, and never less than their own
    /// share leaves (methods that are forced may spoil more). 0 and below mean all samples.
    double noise(double tolerance) const;

    /// For RenderProgress::statistics; nothing without a tolerance.
    void tell(double tolerance, std::map<std::string, double>& statistics) const;

private:
    double _error = 0.0;
};

} // namespace patina
