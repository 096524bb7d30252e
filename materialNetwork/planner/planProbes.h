// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

namespace patina {

struct ProgramCode;

/// A lobe as one place of a material shows it from one angle.
struct ClosureContribution {
    int closure = -1;         ///< in Plan::closures
    const char* kind = "";    ///< `dielectric`, `conductor`, `schlick`...; as in methodTable.h
    float share = 0.0f;       ///< of the luminance of the directional albedo, 0..1
    float beneath = 0.0f;     ///< share of what lies under it in layers
    float reflectance = 0.0f; ///< luminance at normal incidence
    float roughness = 0.0f;   ///< root of alpha, mean of both axes; 0: a mirror
    float thickness = 0.0f;   ///< of a film, nm
    bool tabulated = false;   ///< its albedo is looked up over the cosine, by all who ask for it
};

/// One place of a material from one angle.
struct DirectionProbe {
    float cosine = 1.0f;
    float albedo = 0.0f; ///< luminance, all that does not pass straight on
    std::vector<ClosureContribution> closures;
};

/// Number i of a sequence that fills the unit interval evenly; each dimension is one of its own
/// (Roberts 2018).
float spread(int i, int dimension);

/// Probes a material: at one place when it is constant, else at some that spread over its
/// textures, with primvars from 0 to 1; each from the middles of the quarters of the cosine.
/// @param code with the default methods
/// @returns place by place; empty where there is no surface
std::vector<std::vector<DirectionProbe>> probeProgram(const ProgramCode& code);

} // namespace patina
