// SPDX-License-Identifier: Apache-2.0
// Nodes of MaterialX 1.38 that 1.39 writes with others: networks are rewritten before they are
// read.
#include "materialNetwork/nodes/nodeTable.h"

namespace patina {

namespace {

constexpr NodeRow legacy(const char* id, const char* category, const char* inputs,
                         const char* outputs, const char* types = nullptr) {
    return {id,      category, inputs,
            outputs, nullptr,  Algebra::None,
            types,   nullptr,  ClosureKind::Unsupported};
}

const NodeRow rows[] = {
    legacy("ND_swizzle_float_$", "swizzle", "float in=0, string channels=", "$", tupleTypes),
    legacy("ND_swizzle_color3_$", "swizzle", "color3 in=0, string channels=", "$", allTypes),
    legacy("ND_swizzle_color4_$", "swizzle", "color4 in=0, string channels=", "$", allTypes),
    legacy("ND_swizzle_vector2_$", "swizzle", "vector2 in=0, string channels=", "$", allTypes),
    legacy("ND_swizzle_vector3_$", "swizzle", "vector3 in=0, string channels=", "$", allTypes),
    legacy("ND_swizzle_vector4_$", "swizzle", "vector4 in=0, string channels=", "$", allTypes),
    legacy("ND_thin_surface", "thin_surface",
           "BSDF front_bsdf, EDF front_edf, BSDF back_bsdf, EDF back_edf, float opacity=1",
           "surfaceshader"),
};

} // namespace

NodeRows legacyNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
