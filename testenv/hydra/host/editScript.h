// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/host/host.h"

#include <string>

namespace patina {

/// Runs a text of edits on a host while it renders; one a line, # begins a comment:
///
///     session FILE       the session layer becomes a copy of this layer
///     size WIDTH HEIGHT
///     camera PATH
///     frame CODE
///     refine LEVEL
///     purposes A,B
///     aovs A,B
///     set KEY VALUE      a render setting; a number, true or false, or text
///     pause | resume | stop | restart
///     execute COUNT      repaints
///     render             repaints until converged
///     frames PREFIX      the same; every image that is seen becomes PREFIX0000.exr, ...
///     write FILE.exr
///
/// @throws std::runtime_error naming file and line
void runEditScript(Host& host, const UsdStageRefPtr& stage, const std::string& file);

/// A setting's value as a user writes it: true, false, a whole number, a number, else text.
VtValue settingOf(const std::string& text);

} // namespace patina
