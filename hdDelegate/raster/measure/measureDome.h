// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/measure/measure.h"

namespace patina::measure {

/// The methods of the choice point domeLight, without shadows: light under three skies of mean 1,
/// by kind of lobe, over normals on the whole sphere. Loading a sky is in no time.
/// @param timed false leaves out the times, which is quick
std::vector<Row> domeLight(bool timed);

} // namespace patina::measure
