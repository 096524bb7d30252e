// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/network/units.h"

namespace patina {

namespace {

constexpr auto distance = Unit::Kind::Distance;
constexpr auto angle = Unit::Kind::Angle;
constexpr double degreesPerRadian = 57.29577951308232;

const struct {
    const char* name;
    Unit::Kind kind;
    double scale;
} units[] = {{"nanometer", distance, 1e-9},
             {"micron", distance, 1e-6},
             {"millimeter", distance, 1e-3},
             {"centimeter", distance, 1e-2},
             {"decimeter", distance, 0.1},
             {"inch", distance, 0.0254},
             {"foot", distance, 0.3048},
             {"yard", distance, 0.9144},
             {"meter", distance, 1.0},
             {"kilometer", distance, 1e3},
             {"mile", distance, 1609.344},
             {"degree", angle, 1.0},
             {"radian", angle, degreesPerRadian},
             {"mm", distance, 1e-3},
             {"cm", distance, 1e-2},
             {"dm", distance, 0.1},
             {"m", distance, 1.0},
             {"km", distance, 1e3},
             {"in", distance, 0.0254},
             {"ft", distance, 0.3048},
             {"yd", distance, 0.9144},
             {"mi", distance, 1609.344},
             {"deg", angle, 1.0},
             {"rad", angle, degreesPerRadian}};

/// Inputs with a unit of their own, by a part of the definition's name.
const struct {
    const char* id;
    const char* input;
    double scale;
} measured[] = {{"_bsdf", "thinfilm_thickness", 1e-9},
                {"thin_film_bsdf", "thickness", 1e-9},
                {"standard_surface", "thin_film_thickness", 1e-9},
                {"open_pbr_surface", "thin_film_thickness", 1e-6},
                {"gltf_pbr", "iridescence_thickness", 1e-9},
                {"gltf_pbr", "anisotropy_rotation", degreesPerRadian}};

} // namespace

Unit unitOf(const std::string& name) {
    for (const auto& unit : units)
        if (name == unit.name) return {unit.kind, unit.scale};
    return {};
}

double unitFactor(const Unit& unit, const std::string& id, const std::string& input,
                  double metersPerUnit) {
    if (unit.kind == Unit::Kind::Unknown) return 1.0;
    for (const auto& row : measured)
        if (input == row.input && id.find(row.id) != std::string::npos)
            return unit.scale / row.scale;
    if (unit.kind == Unit::Kind::Angle || !(metersPerUnit > 0.0)) return unit.scale;
    return unit.scale / metersPerUnit;
}

} // namespace patina
