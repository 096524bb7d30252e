// SPDX-License-Identifier: Apache-2.0
#pragma once

// The shader dialect as C++: every lobe in float (patina::sh), from the text that the rasterizer
// reads as GLSL. shaders/oracle.h has the same in double.
//
// Every lobe X offers, with the structs and event bits of lib/lobe.glsl:
//   xSetup(inputs of the MaterialX node without weight, normal, tangent) -> XLobe
//     any input is safe
//   xEval(lobe, wo, wi) -> LobeEval: value times |cos wi|, and pdf
//   xSample(lobe, wo, u in [0, 1)^3) -> LobeSample
//   xAlbedo(lobe, wo) -> directional albedo
// Where a lobe differs from the default, its file overloads one of these for its struct; C++
// looks which there are (materialNetwork/ir/lobeFacts.h):
//   lobeFix(lobe, wo, albedo) -> the share that it keeps from the base of a layer, without tint
//     looks up all that depends on wo alone; albedo is exact for interfaces, and else an estimate
//     that is good enough to choose lobes by. Default: xAlbedo, and 1
//   lobeRoughness(lobe) -> GGX alpha, mean of both axes. Default: 1
//   lobePasses(lobe, z) -> the share of its light that an interface of mode RT sends down for good
//   lobeIsDelta(lobe) -> whether eval is 0 everywhere. Default: false
//   xAt(lobe, wo) -> lobe (microfacet lobes only): with the energy factors for this wo looked up,
//     for a caller that evaluates or samples several times from there

#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace patina {

/// Baked directional albedo tables, sh::ALBEDO_TABLE_SIZE floats; shaders/lib/albedoTable.glsl says
/// how they are laid out. Written by shaders/bake at build time. The rasterizer uploads them.
extern const float* const patinaAlbedoTable;

namespace sh {
#include "shaders/compat/cpp.h"
inline float albedoTableFetch(int index) {
    return float(patinaAlbedoTable[index]);
}
#include "shaders/lobes.glsl"
} // namespace sh

#include "shaders/compat/cppEnd.h"

} // namespace patina
