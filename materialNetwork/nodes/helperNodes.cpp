// SPDX-License-Identifier: Apache-2.0
// Nodes that turn artistic parameters into those of lobes.
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

namespace patina {

namespace {

using glm::vec2;
using glm::vec4;
using Call = const PatternCall&;

constexpr Pattern roughnessAnisotropy =
    pattern("vec4(patternRoughnessAnisotropy($0.x, $1.x), 0.0, 0.0)", [](Call c) {
        c.out() = vec4(sh::patternRoughnessAnisotropy(c.x(0), c.x(1)), 0.0f, 0.0f);
    });

constexpr Pattern roughnessDual =
    pattern("vec4(patternRoughnessDual($0.xy), 0.0, 0.0)",
            [](Call c) { c.out() = vec4(sh::patternRoughnessDual(vec2(c.in(0))), 0.0f, 0.0f); });

constexpr Pattern glossinessAnisotropy =
    pattern("vec4(patternRoughnessAnisotropy(1.0 - $0.x, $1.x), 0.0, 0.0)", [](Call c) {
        c.out() = vec4(sh::patternRoughnessAnisotropy(1.0f - c.x(0), c.x(1)), 0.0f, 0.0f);
    });

constexpr Pattern artisticIor =
    pattern("nodeArtisticIor($0, $1); nodeArtisticExtinction($0, $1)", [](Call c) {
        vec4 ior(0.0f), extinction(0.0f);
        for (int i = 0; i < 3; ++i) {
            ior[i] = sh::patternArtisticIor(c.in(0)[i], c.in(1)[i]);
            extinction[i] = sh::patternArtisticExtinction(c.in(0)[i], ior[i]);
        }
        c.out(0) = ior;
        c.out(1) = extinction;
    });

constexpr Pattern blackbody = pattern("vec4(patternBlackbody($0.x), 0.0)", [](Call c) {
    c.out() = vec4(sh::patternBlackbody(c.x(0)), 0.0f);
});

constexpr Pattern dispersedIor =
    spectralPattern("vec4(patternDispersedIor($0.x, $1.x, $2.x, 0.0))", [](Call c) {
        c.out() = vec4(sh::patternDispersedIor(c.x(0), c.x(1), c.x(2), c.point().wavelength));
    });

/// Reached at run time only by an input that varies.
constexpr Pattern isUniform = rarePattern("vec4(0.0)", [](Call c) { c.out() = vec4(0.0f); });

const NodeRow rows[] = {
    {"ND_roughness_anisotropy", "roughness_anisotropy", "float roughness=0, float anisotropy=0",
     "vector2", roughnessAnisotropy},
    {"ND_roughness_dual", "roughness_dual", "vector2 roughness=0", "vector2", roughnessDual},
    {"ND_glossiness_anisotropy", "glossiness_anisotropy", "float glossiness=1, float anisotropy=0",
     "vector2", glossinessAnisotropy},
    {"ND_artistic_ior", "artistic_ior",
     "color3 reflectivity=0.944 0.776 0.373, color3 edge_color=0.998 0.981 0.751",
     "color3 ior, color3 extinction", artisticIor},
    {"ND_blackbody", "blackbody", "float temperature=5000", "color3", blackbody},
    {"ND_patina_dispersed_ior", "patina_dispersed_ior",
     "float ior=1.5, float abbe_number=0, float scale=1", "float", dispersedIor, Algebra::Disperse,
     nullptr, nullptr, true},
    {"ND_isuniform_$", "isuniform", "$ in=0", "float", isUniform, Algebra::IsUniform,
     "float color3"},
};

} // namespace

NodeRows helperNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
