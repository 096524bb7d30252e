// SPDX-License-Identifier: Apache-2.0
// Image nodes that bring their own placement: glTF's, latitude-longitude maps, three planes.
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"

#include "shaders/patterns.h"

#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec3;
using glm::vec4;
using Call = const PatternCall&;

/// The texel at a place, or the value of an input where there is no image.
vec4 texel(Call c, int handle, const vec2& uv, float footprint, int fallback) {
    if (handle < 0) return c.in(fallback);
    return c.context.textures->sample(handle, uv, footprint);
}

/// Inputs (file, default, texcoord, pivot, scale, rotate, offset, ...). glTF's own transform turns
/// the other way round about the upper left corner.
vec4 gltfTexel(Call c, int order) {
    const vec2 scale(c.in(4));
    const vec2 inverse(scale.x != 0.0f ? 1.0f / scale.x : 0.0f,
                       scale.y != 0.0f ? 1.0f / scale.y : 0.0f);
    const vec2 uv = sh::patternPlace2d(vec2(c.in(2)), vec2(c.in(3)), inverse, -c.x(5),
                                       vec2(-c.in(6).x, c.in(6).y), order);
    const float widest = std::fmax(std::fabs(scale.x), std::fabs(scale.y));
    return texel(c, c.data.handle, uv, c.point().uvFootprint * widest, 1);
}
constexpr char gltfImageGlsl[] =
    "$t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), point.uvFootprint * "
    "max(abs($4.x), abs($4.y))) * $8";
constexpr Pattern gltfImage =
    rarePattern(gltfImageGlsl, [](Call c) { c.out() = gltfTexel(c, c.whole(7)) * c.in(8); });
constexpr Pattern gltfScalarImage =
    rarePattern("vec4($t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), point.uvFootprint * "
                "max(abs($4.x), abs($4.y))).x * $8.x)",
                [](Call c) { c.out() = vec4(gltfTexel(c, c.whole(7)).x * c.x(8)); });
/// Further inputs (color, geomcolor).
constexpr char gltfColorImageGlsl[] =
    "$t(nodeGltfUv($2, $3, $4, $5, $6, 0), point.uvFootprint * max(abs($4.x), "
    "abs($4.y))) * $8 * $9; vec4(($t(nodeGltfUv($2, $3, $4, $5, $6, 0), "
    "point.uvFootprint * max(abs($4.x), abs($4.y))) * $8 * $9).w)";
constexpr Pattern gltfColorImage = rarePattern(gltfColorImageGlsl, [](Call c) {
    const vec4 t = gltfTexel(c, 0) * c.in(8) * c.in(9);
    c.out(0) = t;
    c.out(1) = vec4(t.w);
});

/// Further inputs (normal, tangent, bitangent).
constexpr char gltfNormalMapGlsl[] =
    "vec4(patternNormalMap($t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), "
    "point.uvFootprint * max(abs($4.x), abs($4.y))).xyz, vec2(1.0), $8.xyz, $9.xyz, "
    "${10}.xyz), 0.0)";
constexpr Pattern gltfNormalMap = rarePattern(gltfNormalMapGlsl, [](Call c) {
    c.out() = vec4(sh::patternNormalMap(vec3(gltfTexel(c, c.whole(7))), vec2(1.0f), vec3(c.in(8)),
                                        vec3(c.in(9)), vec3(c.in(10))),
                   0.0f);
});

/// Further inputs (thicknessMin, thicknessMax). Black texels are the thickest, as MaterialX has it.
constexpr Pattern gltfThickness =
    rarePattern("vec4($9.x + ($8.x - $9.x) * $t(nodeGltfUv($2, $3, $4, $5, $6, 0), "
                "point.uvFootprint * max(abs($4.x), abs($4.y))).y)",
                [](Call c) { c.out() = vec4(c.x(9) + (c.x(8) - c.x(9)) * gltfTexel(c, 0).y); });
/// Further inputs (anisotropy_strength, anisotropy_rotation).
constexpr Pattern gltfAnisotropy = rarePattern(
    "vec4($8.x * $t(nodeGltfUv($2, $3, $4, $5, $6, 0), point.uvFootprint * "
    "max(abs($4.x), abs($4.y))).z); vec4($9.x + atan($t(nodeGltfUv($2, $3, $4, $5, $6, "
    "0), point.uvFootprint * max(abs($4.x), abs($4.y))).y * 2.0 - 1.0, $t(nodeGltfUv($2, "
    "$3, $4, $5, $6, 0), point.uvFootprint * max(abs($4.x), abs($4.y))).x * 2.0 - 1.0))",
    [](Call c) {
        const vec4 t = gltfTexel(c, 0);
        c.out(0) = vec4(c.x(8) * t.z);
        c.out(1) = vec4(c.x(9) + std::atan2(t.y * 2.0f - 1.0f, t.x * 2.0f - 1.0f));
    });

/// Inputs (file, default, viewdir, rotation in degrees).
constexpr Pattern latLongImage = rarePattern("$t(nodeLatLong($2.xyz, $3.x), 0.0)", [](Call c) {
    const vec3 d(c.in(2));
    const float u = std::atan2(d.x, d.z) * -0.15915494f + 0.5f + c.x(3) / 360.0f;
    const float v = std::asin(glm::clamp(d.y, -1.0f, 1.0f)) * 0.31830989f + 0.5f;
    c.out() = texel(c, c.data.handle, vec2(u, v), 0.0f, 1);
});

/// Inputs (filex, filey, filez, default, position, normal, upaxis, blend); data.value holds the
/// three handles.
vec4 triplanarTexel(Call c) {
    const vec3 p(c.in(4));
    const int up = c.whole(6);
    const vec2 x = up == 2 ? vec2(p.y, p.z) : vec2(p.z, p.y);
    const vec2 y = up == 0 ? vec2(p.z, p.x) : vec2(p.x, p.z);
    const vec2 z = up == 0 ? vec2(-p.y, p.x) : vec2(p.x, p.y);
    vec3 w = glm::abs(vec3(c.in(5)));
    const float sum = w.x + w.y + w.z;
    if (!(sum > 0.0f)) return c.in(3);
    const float sharpness = 1.0f / glm::clamp(c.x(7), 0.03f, 1.0f);
    for (int i = 0; i < 3; ++i)
        w[i] = std::pow(w[i] / sum, sharpness);
    const float total = w.x + w.y + w.z;
    if (!(total > 0.0f)) return c.in(3);
    const vec2 at[3] = {x, y, z};
    const float width = c.point().uvFootprint * c.point().lengthPerUv;
    vec4 result(0.0f);
    for (int i = 0; i < 3; ++i)
        if (w[i] > 0.0f) result += texel(c, int(c.data.value[i]), at[i], width, 3) * (w[i] / total);
    return result;
}
constexpr Pattern triplanar =
    rarePattern("nodeTriplanar($X(nodePlane(0, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), "
                "$Y(nodePlane(1, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $Z(nodePlane(2, "
                "$4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $3, $5.xyz, $7.x)",
                [](Call c) { c.out() = triplanarTexel(c); });
constexpr Pattern triplanarScalar = rarePattern(
    "vec4(nodeTriplanar($X(nodePlane(0, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), "
    "$Y(nodePlane(1, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $Z(nodePlane(2, "
    "$4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $3, $5.xyz, $7.x).x)",
    [](Call c) { c.out() = vec4(triplanarTexel(c).x); });
void prepareTriplanar(PatternSetup& setup, PatternData& data) {
    data.value = vec4(float(openImage(setup, "filex")), float(openImage(setup, "filey")),
                      float(openImage(setup, "filez")), 0.0f);
}

#define PATINA_ADDRESS                                                                             \
    "string uaddressmode=periodic, string vaddressmode=periodic, string filtertype=linear"
#define PATINA_GLTF(type, missing)                                                                 \
    "filename file=, " type " default=" missing ", vector2 texcoord=@UV0, vector2 pivot=0 1, "     \
    "vector2 scale=1, float rotate=0, vector2 offset=0, integer operationorder="
#define PATINA_FRAME "vector3 normal=@Nworld, vector3 tangent=@Tworld, vector3 bitangent=@Bworld, "
#define PATINA_TRIPLANAR                                                                           \
    "filename filex=, filename filey=, filename filez=, $ default=0, vector3 position=@Pobject, "  \
    "vector3 normal=@Nobject, integer upaxis=2, float blend=1, string layerx=, string layery=, "   \
    "string layerz=, string filtertype=linear, string framerange=, integer frameoffset=0, "        \
    "string frameendaction=constant"

constexpr Algebra none = Algebra::None;

const NodeRow rows[] = {
    {"ND_gltf_image_$_$_1_0", "gltf_image", PATINA_GLTF("$", "0") "0, $ factor=1, " PATINA_ADDRESS,
     "$", gltfImage, none, "color3 vector3", prepareImage, true},
    {"ND_gltf_image_color4_color4_1_0", "gltf_image",
     PATINA_GLTF("color4", "0") "1, color4 factor=1, " PATINA_ADDRESS, "color4", gltfImage, none,
     nullptr, prepareImage, true},
    {"ND_gltf_image_float_float_1_0", "gltf_image",
     PATINA_GLTF("float", "0") "0, float factor=1, " PATINA_ADDRESS, "float", gltfScalarImage, none,
     nullptr, prepareImage, true},
    {"ND_gltf_colorimage", "gltf_colorimage",
     PATINA_GLTF("color4", "0") "1, color4 color=1, color4 geomcolor=1, " PATINA_ADDRESS,
     "color3 outcolor, float outa", gltfColorImage, none, nullptr, prepareImage, true},
    {"ND_gltf_normalmap_vector3_1_0", "gltf_normalmap",
     PATINA_GLTF("vector3", "0.5 0.5 1") "0, " PATINA_FRAME PATINA_ADDRESS, "vector3",
     gltfNormalMap, none, nullptr, prepareImage, true},
    {"ND_gltf_iridescence_thickness_float_1_0", "gltf_iridescence_thickness",
     "filename file=, vector3 default=0, vector2 texcoord=@UV0, vector2 pivot=0, vector2 scale=1, "
     "float rotate=0, vector2 offset=0, integer operationorder=0, float thicknessMin=100, "
     "float thicknessMax=400, " PATINA_ADDRESS,
     "float", gltfThickness, none, nullptr, prepareImage, true},
    {"ND_gltf_anisotropy_image", "gltf_anisotropy_image",
     PATINA_GLTF("vector3", "1 0.5 1") "0, float anisotropy_strength=1, "
                                       "float anisotropy_rotation=0, " PATINA_ADDRESS,
     "float anisotropy_strength_out, float anisotropy_rotation_out", gltfAnisotropy, none, nullptr,
     prepareImage, true},
    {"ND_latlongimage", "latlongimage",
     "filename file=, color3 default=0, vector3 viewdir=0 0 1, float rotation=0, "
     "string vaddressmode=mirror",
     "color3", latLongImage, none, nullptr, prepareImage, true},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$", triplanarScalar,
     none, "float", prepareTriplanar, true},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$", triplanar, none,
     tupleTypes, prepareTriplanar, true},
};

} // namespace

NodeRows placedImageNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
