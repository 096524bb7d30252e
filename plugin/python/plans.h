// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/methodPlan.h"

#include <pybind11/pybind11.h>

namespace patina {

/// A plan of methods as Python sees it: tolerance, error, albedo, varies, and the list of choices.
pybind11::dict planDict(const MethodPlan& plan);
/// Its choices, or those of a scene.
pybind11::list choiceList(const std::vector<PlannedMethod>& choices);

} // namespace patina
