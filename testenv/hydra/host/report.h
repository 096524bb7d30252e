// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/host/host.h"

#include <pxr/base/js/value.h>

#include <string>
#include <utility>
#include <vector>

namespace patina {

/// Seconds of each phase, in order.
using HostTimes = std::vector<std::pair<std::string, double>>;

/// The contents of pixels, as JSON: for each the prim, the instancer and its instance. Needs the
/// outputs primId and instanceId.
/// @param pixels from the top left; those outside the image are left out
JsArray picksOf(Host& host, const std::vector<std::pair<int, int>>& pixels);
/// The same for each (prim, instance) that is seen, with the number of its pixels.
JsArray allPicksOf(Host& host);

/// Times, render stats of the delegate, peak memory of the process in bytes.
JsObject statisticsOf(Host& host, const HostTimes& times);

/// @param path file, or - for standard output. @throws std::runtime_error naming it
void writeJson(const JsObject& object, const std::string& path);

} // namespace patina
