// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/measure/measure.h"

namespace patina::measure {

/// Measures the methods of the choice point layering: a dielectric interface over diffuse bases
/// (kind `layer`) and over metals (`layerOverMetal`, by the larger of both roughnesses). Also
/// measures scaling over a grey base for each method that finds the albedo (`layerBy...`). No plan
/// looks these rows up, since they only repeat the error of directionalAlbedo. Times are the extra
/// time of a layer over its base, for set-up, one value and one sample.
/// @param timed false leaves out the times, which is quick
std::vector<Row> layering(bool timed);

/// The methods of the choice point layerTransmittance on the same subjects: albedo scaling as each
/// of them has it, against the same truths.
std::vector<Row> layerTransmittance(bool timed);

} // namespace patina::measure
