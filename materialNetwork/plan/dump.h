// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/plan/plan.h"

#include <string>

namespace patina {

// Canonical readable text of each stage of a material. Equal content gives equal text, so tests
// compare it with reviewed files.

std::string dumpNetwork(const Network& network);

/// One line per node; only inputs that differ from the definition's default are written.
std::string dumpGraph(const Graph& graph);

/// Lobes with their parameters and weights (E is a lobe's directional albedo at wo), emission,
/// interior, presence, and what was left out.
std::string dumpPlan(const Plan& plan);

} // namespace patina
