// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "shaders/measure/measure.h"

namespace patina::measure {

/// The methods of the choice point layering: a dielectric interface over diffuse bases (kind
/// `layer`) and over metals (`layerOverMetal`, along the rougher of both roughnesses), and scaling
/// over a grey base with the albedo found by each of its methods (`layerBy...`, which no plan looks
/// up: it adds what directionalAlbedo is off). Times are what a layer adds to its base, for laying
/// out, one value and one sample.
/// @param timed false leaves out the times, which is quick
std::vector<Row> layering(bool timed);

/// The methods of the choice point layerTransmittance on the same subjects: albedo scaling as each
/// of them has it, against the same truths.
std::vector<Row> layerTransmittance(bool timed);

} // namespace patina::measure
