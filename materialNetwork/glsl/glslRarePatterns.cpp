#include "materialNetwork/glsl/glslPatternRows.h"

#include <iterator>

namespace patina {

namespace {

// MaterialX multiplies rows from the left; as columns from the right.
const GlslPatternRow rows[] = {
    {"ND_range_float", "nodeRange($0, $1, $2, $3, $4, $5, $6.x)"},
    {"ND_safepower_float", "nodeSafePower($0, $1)"},
    {"ND_colorcorrect_color3",
     "nodeColorCorrect($0, $1.x, $2.x, $3.x, $4.x, $5.x, $6.x, $7.x, $8.x)"},
    {"ND_overlay_color3", "$1 + (nodeOverlay($0, $1) - $1) * $2.x"},
    {"ND_burn_color3", "nodeBurn($0, $1, $2.x)"},
    {"ND_dodge_color3", "nodeDodge($0, $1, $2.x)"},
    {"ND_over_color4", "$1 + ($0 + $1 * (1.0 - $0.w) - $1) * $2.x"},
    {"ND_in_color4", "$1 + ($0 * $1.w - $1) * $2.x"},
    {"ND_out_color4", "$1 + ($0 * (1.0 - $1.w) - $1) * $2.x"},
    {"ND_mask_color4", "$1 + ($1 * $0.w - $1) * $2.x"},
    {"ND_matte_color4", "$1 + (nodeMatte($0, $1) - $1) * $2.x"},
    {"ND_disjointover_color4", "$1 + (nodeDisjointOver($0, $1) - $1) * $2.x"},
    {"ND_convert_integer_boolean", "vec4($0.x != 0.0 ? 1.0 : 0.0)"},
    {"ND_convert_vector2_color4", "vec4($0.xy, 0.0, 1.0)"},
    {"ND_logical_xor", "vec4(($0.x != 0.0) != ($1.x != 0.0) ? 1.0 : 0.0)"},
    {"ND_switch_float", "nodeSwitch(${10}.x, vec4[10]($0, $1, $2, $3, $4, $5, $6, $7, $8, $9))"},
    {"ND_isuniform_float", "vec4(0.0)"},
    {"ND_noise2d_vector4", "nodeNoise2Quad($2.xy) * $0 + $1.x"},
    {"ND_noise3d_vector4", "nodeNoise3Quad($2.xyz) * $0 + $1.x"},
    {"ND_fractal2d_vector2", "nodeFractal2Pair($4.xy, nodeWhole($1.x), $2.x, $3.x) * $0"},
    {"ND_fractal2d_vector4", "nodeFractal2Quad($4.xy, nodeWhole($1.x), $2.x, $3.x) * $0"},
    {"ND_fractal3d_vector2", "nodeFractal3Pair($4.xyz, nodeWhole($1.x), $2.x, $3.x) * $0"},
    {"ND_fractal3d_vector4", "nodeFractal3Quad($4.xyz, nodeWhole($1.x), $2.x, $3.x) * $0"},
    {"ND_unifiednoise2d_float",
     "nodeToRange(nodeUnified2($0.xy * $1.xy + $2.xy, $3.x, nodeWhole($7.x), $8.x, $9.x, "
     "nodeWhole(${10}.x), nodeWhole(${11}.x)), $4.x, $5.x, $6.x)"},
    {"ND_unifiednoise3d_float",
     "nodeToRange(nodeUnified3($0.xyz * $1.xyz + $2.xyz, $3.x, nodeWhole($7.x), $8.x, "
     "$9.x, nodeWhole(${10}.x), nodeWhole(${11}.x)), $4.x, $5.x, $6.x)"},
    {"ND_flake2d",
     "nodeFlake($0.x, $1.x, $2.x, vec3($3.xy, 0.0), $4.xyz, $5.xyz, $6.xyz); "
     "vec4(nodeFlakeHit.random); vec4(nodeFlakeHit.presence); vec4(nodeFlakeHit.normal, "
     "0.0)"},
    {"ND_flake3d",
     "nodeFlake($0.x, $1.x, $2.x, $3.xyz, $4.xyz, $5.xyz, $6.xyz); "
     "vec4(nodeFlakeHit.random); vec4(nodeFlakeHit.presence); vec4(nodeFlakeHit.normal, "
     "0.0)"},
    {"ND_randomfloat_float", "vec4(nodeRandom($0.x * 4096.0, $3.x, $1.x, $2.x))"},
    {"ND_randomfloat_integer", "vec4(nodeRandom($0.x, $3.x, $1.x, $2.x))"},
    {"ND_randomcolor_float",
     "nodeRandomColor($0.x, vec2($1.x, $2.x), vec2($3.x, $4.x), vec2($5.x, $6.x), $7.x)"},
    {"ND_ramp",
     "nodeRamp($0.xy, nodeWhole($1.x), nodeWhole($2.x), nodeWhole($3.x), float[10]($4.x, "
     "$6.x, $8.x, ${10}.x, ${12}.x, ${14}.x, ${16}.x, ${18}.x, ${20}.x, ${22}.x), "
     "vec4[10]($5, $7, $9, ${11}, ${13}, ${15}, ${17}, ${19}, ${21}, ${23}))"},
    {"ND_ramp_gradient",
     "nodeRampGradient($0.x, $1.x, $2.x, $3, $4, nodeWhole($5.x), $6, $7.x, $8.x)"},
    {"ND_constant_matrix33", "3|$A0"},
    {"ND_add_matrix33", "3|$A0 + $A1"},
    {"ND_subtract_matrix33", "3|$A0 - $A1"},
    {"ND_add_matrix33FA", "3|$A0 + $1.x"},
    {"ND_subtract_matrix33FA", "3|$A0 - $1.x"},
    {"ND_multiply_matrix33", "3|$A1 * $A0"},
    {"ND_divide_matrix33", "3|nodeInverse($A1) * $A0"},
    {"ND_transpose_matrix33", "3|transpose($A0)"},
    {"ND_invertmatrix_matrix33", "3|nodeInverse($A0)"},
    {"ND_determinant_matrix33", "vec4(determinant($A0))"},
    {"ND_ifgreater_matrix33", "3|$0.x > $1.x ? $A2 : $A3"},
    {"ND_ifgreatereq_matrix33", "3|$0.x >= $1.x ? $A2 : $A3"},
    {"ND_ifequal_matrix33", "3|$0.x == $1.x ? $A2 : $A3"},
    {"ND_switch_matrix33",
     "3|nodeSwitch3(${10}.x, mat3[10]($A0, $A1, $A2, $A3, $A4, $A5, $A6, $A7, $A8, $A9))"},
    {"ND_constant_matrix44", "4|$B0"},
    {"ND_add_matrix44", "4|$B0 + $B1"},
    {"ND_subtract_matrix44", "4|$B0 - $B1"},
    {"ND_add_matrix44FA", "4|$B0 + $1.x"},
    {"ND_subtract_matrix44FA", "4|$B0 - $1.x"},
    {"ND_multiply_matrix44", "4|$B1 * $B0"},
    {"ND_divide_matrix44", "4|nodeInverse($B1) * $B0"},
    {"ND_transpose_matrix44", "4|transpose($B0)"},
    {"ND_invertmatrix_matrix44", "4|nodeInverse($B0)"},
    {"ND_determinant_matrix44", "vec4(determinant($B0))"},
    {"ND_ifgreater_matrix44", "4|$0.x > $1.x ? $B2 : $B3"},
    {"ND_ifgreatereq_matrix44", "4|$0.x >= $1.x ? $B2 : $B3"},
    {"ND_ifequal_matrix44", "4|$0.x == $1.x ? $B2 : $B3"},
    {"ND_switch_matrix44",
     "4|nodeSwitch4(${10}.x, mat4[10]($B0, $B1, $B2, $B3, $B4, $B5, $B6, $B7, $B8, $B9))"},
    {"ND_extract_matrix33", "vec4($A0[clamp(nodeWhole($1.x), 0, 2)], 0.0)"},
    {"ND_extract_matrix44", "$B0[clamp(nodeWhole($1.x), 0, 3)]"},
    {"ND_creatematrix_vector3_matrix33", "vec4($0.xyz, 0.0); vec4($1.xyz, 0.0); vec4($2.xyz, 0.0)"},
    {"ND_creatematrix_vector3_matrix44",
     "vec4($0.xyz, 0.0); vec4($1.xyz, 0.0); vec4($2.xyz, 0.0); vec4($3.xyz, 1.0)"},
    {"ND_creatematrix_vector4_matrix44", "$0; $1; $2; $3"},
    {"ND_transformmatrix_vector2M3", "vec4(($A1 * vec3($0.xy, 1.0)).xy, 0.0, 0.0)"},
    {"ND_transformmatrix_vector3", "vec4($A1 * $0.xyz, 0.0)"},
    {"ND_transformmatrix_vector3M4", "vec4(($B1 * vec4($0.xyz, 1.0)).xyz, 0.0)"},
    {"ND_transformmatrix_vector4", "$B1 * $0"},
    {"ND_transformpoint_vector3", "nodeTransformPoint($m, $0)"},
    {"ND_transformvector_vector3", "nodeTransformVector($m, $0)"},
    {"ND_transformnormal_vector3", "nodeTransformNormal($m, $0)"},
    {"ND_reflect_vector3", "vec4($0.xyz - $1.xyz * (2.0 * dot($1.xyz, $0.xyz)), 0.0)"},
    {"ND_refract_vector3", "nodeRefract($0.xyz, $1.xyz, $2.x)"},
    {"ND_facingratio_float", "nodeFacingRatio($0.xyz, $1.xyz, $2.x, $3.x)"},
    {"ND_gooch_shade", "nodeGooch($0, $1, $2.x, $3.x, $4.xyz)"},
    {"ND_frame_float", "vec4($0.x)"},
    {"ND_time_float", "vec4($0.x != 0.0 ? $1.x / $0.x : 0.0)"},
    {"ND_heighttonormal_vector3", "vec4(0.5, 0.5, 1.0, 0.0)"},
    {"ND_blur_float", "$0"},
    {"PatinaShiftTexcoord_vector2", "nodeShiftTexcoord($0, $1.x)"},
    {"PatinaShiftPosition", "nodeShiftPosition($0, $1.x, $2.x)"},
    {"PatinaMoveTexcoord_vector2", "$0 + vec4(nodeBlurTap($1.x, $2.x, $3.x, $4.x), 0.0, 0.0)"},
    {"PatinaMovePosition", "nodeMovePosition($0, nodeBlurTap($1.x, $2.x, $3.x, $4.x), $5.x)"},
    {"PatinaSlope", "nodeSlope($0.x, $1.x, $2.x, $3.x, $4.xy, $5.xy, $6.xy)"},
    {"ND_gltf_image_color3_color3_1_0",
     "$t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), point.uvFootprint * "
     "max(abs($4.x), abs($4.y))) * $8"},
    {"ND_gltf_image_float_float_1_0",
     "vec4($t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), point.uvFootprint * "
     "max(abs($4.x), abs($4.y))).x * $8.x)"},
    {"ND_gltf_colorimage",
     "$t(nodeGltfUv($2, $3, $4, $5, $6, 0), point.uvFootprint * max(abs($4.x), "
     "abs($4.y))) * $8 * $9; vec4(($t(nodeGltfUv($2, $3, $4, $5, $6, 0), "
     "point.uvFootprint * max(abs($4.x), abs($4.y))) * $8 * $9).w)"},
    {"ND_gltf_normalmap_vector3_1_0",
     "vec4(patternNormalMap($t(nodeGltfUv($2, $3, $4, $5, $6, nodeWhole($7.x)), "
     "point.uvFootprint * max(abs($4.x), abs($4.y))).xyz, vec2(1.0), $8.xyz, $9.xyz, "
     "${10}.xyz), 0.0)"},
    {"ND_gltf_iridescence_thickness_float_1_0",
     "vec4($9.x + ($8.x - $9.x) * $t(nodeGltfUv($2, $3, $4, $5, $6, 0), "
     "point.uvFootprint * max(abs($4.x), abs($4.y))).y)"},
    {"ND_gltf_anisotropy_image",
     "vec4($8.x * $t(nodeGltfUv($2, $3, $4, $5, $6, 0), point.uvFootprint * "
     "max(abs($4.x), abs($4.y))).z); vec4($9.x + atan($t(nodeGltfUv($2, $3, $4, $5, $6, "
     "0), point.uvFootprint * max(abs($4.x), abs($4.y))).y * 2.0 - 1.0, $t(nodeGltfUv($2, "
     "$3, $4, $5, $6, 0), point.uvFootprint * max(abs($4.x), abs($4.y))).x * 2.0 - 1.0))"},
    {"ND_latlongimage", "$t(nodeLatLong($2.xyz, $3.x), 0.0)"},
    {"ND_triplanarprojection_float",
     "vec4(nodeTriplanar($X(nodePlane(0, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), "
     "$Y(nodePlane(1, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $Z(nodePlane(2, "
     "$4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $3, $5.xyz, $7.x).x)"},
    {"ND_triplanarprojection_color3",
     "nodeTriplanar($X(nodePlane(0, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), "
     "$Y(nodePlane(1, $4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $Z(nodePlane(2, "
     "$4.xyz, nodeWhole($6.x)), nodePlaneFootprint()), $3, $5.xyz, $7.x)"},
    {"ND_hextiledimage_color3",
     "(nodeHexSet($2, $3, $4.x, $5, $6.x, $7, $8.x, $9), nodeHexImage($t(nodeHex.a.uv, "
     "nodeHexFootprint(nodeHex.a, $3)), $t(nodeHex.b.uv, nodeHexFootprint(nodeHex.b, "
     "$3)), $t(nodeHex.c.uv, nodeHexFootprint(nodeHex.c, $3)), ${10}.x, ${11}.x, "
     "${12}.xyz))",
     "$1"},
    {"ND_hextilednormalmap_vector3",
     "(nodeHexSet($2, $3, $4.x, $5, $6.x, $7, $8.x, $9), nodeHexNormal($t(nodeHex.a.uv, "
     "nodeHexFootprint(nodeHex.a, $3)), $t(nodeHex.b.uv, nodeHexFootprint(nodeHex.b, "
     "$3)), $t(nodeHex.c.uv, nodeHexFootprint(nodeHex.c, $3)), ${10}.x, ${11}.x, ${12}.x, "
     "${13}.xyz, ${14}.xyz, ${15}.xyz))",
     "vec4(${13}.xyz, 0.0)"},
    {"UsdPrimvarReader_string", "$1"},
    {"UsdPrimvarReader_matrix", "4|$B1"},
    {"ND_chiang_hair_roughness",
     "nodeHairRoughness($0.x, $1.x, 1.0); nodeHairRoughness($0.x, $1.x, $2.x); "
     "nodeHairRoughness($0.x, $1.x, $3.x)"},
    {"ND_chiang_hair_absorption_from_color", "nodeHairFromColor($0, $1.x)"},
    {"ND_deon_hair_absorption_from_melanin", "nodeHairFromMelanin($0.x, $1.x, $2, $3)"},
};

} // namespace

GlslPatternRows glslRarePatterns() {
    return {rows, std::size(rows)};
}

} // namespace patina
