// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/instanceValues.h"

#include <string>

namespace patina {

// Names of mattes (Cryptomatte). A native instance has the names that its prims have on the stage;
// an instance of a point instancer that of the prototype's prim with its number, as in
// /Trees/Pine/bark[17].

/// Of a prim: its matteName, or its path with that of the instances around.
/// @param steps from the outermost instance to the innermost
std::string objectMatte(const Geometry& prim, const InstanceStep* steps, int count);

/// Of the asset that a prim belongs to: its own, or that of the innermost instance that has one;
/// "default" where none has.
std::string assetMatte(const Geometry& prim, const InstanceStep* steps, int count);

/// Of a material of a prim: its path; "default" where none is bound.
/// @param slot 0: the prim's own; i + 1: that of subset i
std::string materialMatte(const Geometry& prim, size_t slot);

} // namespace patina
