#include "hdDelegate/scene/scenePlan.h"

#include <algorithm>
#include <cmath>

namespace patina {

void ScenePlan::add(const std::string& path, const MethodPlan& material) {
    _materials[path] = material;
    _error = std::max(_error, material.error);
    _albedo = std::max(_albedo, material.albedo);
}

int ScenePlan::depth(double tolerance) const {
    if (tolerance < 0.0) return depthStandard;
    if (tolerance == 0.0 || _albedo >= 1.0) return depthMost;
    if (_albedo <= 0.0) return depthLeast;
    const double vertices = std::log(depthShare * tolerance) / std::log(_albedo);
    return int(std::clamp(std::ceil(vertices), double(depthLeast), double(depthMost)));
}

double ScenePlan::noise(double tolerance) const {
    return tolerance > 0.0
               ? tolerance * (1.0 - depthShare) - std::min(_error, methodShare * tolerance)
               : tolerance;
}

void ScenePlan::tell(double tolerance, std::map<std::string, double>& statistics) const {
    if (tolerance < 0.0) return;
    statistics["predictedError"] = _error;
    statistics["noiseTolerance"] = noise(tolerance);
}

} // namespace patina
