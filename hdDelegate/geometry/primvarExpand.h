// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/triangleMesh.h"
#include "base/diagnostics.h"

namespace patina {

/// How many elements a primvar of each interpolation has on a prim.
struct ElementCounts {
    size_t uniform = 1, varying = 1, vertex = 1, faceVarying = 1;

    size_t of(Interpolation interpolation) const;
};

/// Values of a primvar, one per element, with its indices resolved. Constant primvars give one
/// element, the first of an array. A single value stands for all elements.
///
/// Reported with prim and primvar: a wrong number of elements and a number of components outside
/// 1..16 (nothing is returned), indices out of range and values that are not finite (read as 0).
/// @returns false when the primvar cannot be used
bool expandPrimvar(const Primvar& primvar, const ElementCounts& counts, const std::string& prim,
                   Diagnostics& diagnostics, std::vector<float>& out);

/// Expands as above, for prims on which only constant values make sense. Other interpolations are
/// accepted when they have a single element.
/// @returns false when the primvar cannot be used
bool expandConstant(const Primvar& primvar, const std::string& prim, Diagnostics& diagnostics,
                    MeshAttribute& out);

} // namespace patina
