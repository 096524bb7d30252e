#include "hdDelegate/scene/scenePlan.h"

#include "materialNetwork/planner.h"

#include <algorithm>

namespace patina {

void ScenePlan::add(const MethodPlan& material) {
    _error = std::max(_error, material.error);
}

double ScenePlan::noise(double tolerance) const {
    return tolerance > 0.0 ? tolerance - std::min(_error, methodShare * tolerance) : tolerance;
}

void ScenePlan::tell(double tolerance, std::map<std::string, double>& statistics) const {
    if (tolerance < 0.0) return;
    statistics["predictedError"] = _error;
    statistics["noiseTolerance"] = noise(tolerance);
}

} // namespace patina
