// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// A unit of MaterialX.
struct Unit {
    enum class Kind { Unknown, Distance, Angle };
    Kind kind = Kind::Unknown;
    double scale = 1.0; ///< metres, or degrees
};

/// @param name of MaterialX's library ("inch", "radian"), or of Sdf's displayUnit ("in", "cm")
Unit unitOf(const std::string& name);

/// What the numbers of an input are multiplied by. Angles become degrees and distances units of the
/// scene, but for the inputs that have a unit of their own, such as the thickness of a film.
/// @param id of the node's definition
double unitFactor(const Unit& unit, const std::string& id, const std::string& input,
                  double metersPerUnit);

} // namespace patina
