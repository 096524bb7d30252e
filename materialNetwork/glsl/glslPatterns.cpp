#include "materialNetwork/glsl/glslPatterns.h"

#include "materialNetwork/nodeTable.h"

#include <cctype>
#include <map>
#include <unordered_map>

namespace patina {

namespace {

/// Expressions of a node's outputs, separated by `;`. $0..$9 are inputs (all vec4), $s the size of
/// the first, $m the mode, $p the slot of the primvar. Nodes that share their C++ function share
/// the row.
struct Row {
    const char* id;
    const char* text;
};

const Row rows[] = {
    {"ND_constant_float", "$0"},
    {"ND_convert_float_color3", "$0"},
    {"ND_add_float", "$0 + $1"},
    {"ND_subtract_float", "$0 - $1"},
    {"ND_multiply_float", "$0 * $1"},
    {"ND_divide_float", "nodeDivide($0, $1)"},
    {"ND_modulo_float", "nodeModulo($0, $1)"},
    {"ND_power_float", "nodePower($0, $1)"},
    {"ND_min_float", "min($0, $1)"},
    {"ND_max_float", "max($0, $1)"},
    {"ND_clamp_float", "min(max($0, $1), $2)"},
    {"ND_mix_float", "$1 + ($0 - $1) * $2"},
    {"ND_invert_float", "$1 - $0"},
    {"ND_absval_float", "abs($0)"},
    {"ND_sign_float", "sign($0)"},
    {"ND_floor_float", "floor($0)"},
    {"ND_ceil_float", "ceil($0)"},
    {"ND_round_float", "nodeRound($0)"},
    {"ND_fract_float", "$0 - floor($0)"},
    {"ND_sqrt_float", "sqrt(max($0, vec4(0.0)))"},
    {"ND_ln_float", "log(max($0, vec4(1e-37)))"},
    {"ND_exp_float", "exp(min($0, vec4(80.0)))"},
    {"ND_sin_float", "sin($0)"},
    {"ND_cos_float", "cos($0)"},
    {"ND_tan_float", "tan($0)"},
    {"ND_asin_float", "nodeAsin($0)"},
    {"ND_acos_float", "nodeAcos($0)"},
    {"ND_atan2_float", "atan($0, $1)"},
    {"ND_trianglewave_float", "0.5 - abs(abs($0) - floor(abs($0)) - 0.5)"},
    {"ND_smoothstep_float", "nodeSmoothstep($0, $1, $2)"},
    {"ND_remap_float", "$3 + nodeDivide($0 - $1, $2 - $1) * ($4 - $3)"},

    {"ND_dotproduct_vector3", "vec4(nodeDot($0, $1, $s))"},
    {"ND_magnitude_vector3", "vec4(sqrt(nodeDot($0, $0, $s)))"},
    {"ND_distance_vector3", "vec4(sqrt(nodeDot($0 - $1, $0 - $1, $s)))"},
    {"ND_normalize_vector3", "nodeNormalize($0, $s)"},
    {"ND_crossproduct_vector3", "vec4(cross($0.xyz, $1.xyz), 0.0)"},
    {"ND_rotate2d_vector2", "vec4(patternRotate2d($0.xy, $1.x), 0.0, 0.0)"},
    {"ND_rotate3d_vector3", "vec4(patternRotate3d($0.xyz, $1.x, $2.xyz), 0.0)"},
    {"ND_maxcomponent_color3", "vec4(nodeLargest($0, $s))"},
    {"ND_mincomponent_color3", "vec4(-nodeLargest(-$0, $s))"},
    {"ND_place2d_vector2",
     "vec4(patternPlace2d($0.xy, $1.xy, $2.xy, $3.x, $4.xy, int($5.x)), 0.0, 0.0)"},
    {"UsdTransform2d", "vec4(patternTransform2d($0.xy, $2.xy, $1.x, $3.xy), 0.0, 0.0)"},
    {"ND_luminance_color3", "vec4(vec3(patternLuminance($0.xyz, $1.xyz)), $0.w)"},
    {"ND_rgbtohsv_color3", "vec4(patternRgbToHsv($0.xyz), $0.w)"},
    {"ND_hsvtorgb_color3", "vec4(patternHsvToRgb($0.xyz), $0.w)"},
    {"ND_normalmap_float", "vec4(patternNormalMap($0.xyz, $1.xy, $2.xyz, $3.xyz, $4.xyz), 0.0)"},

    {"ND_convert_color3_color4", "vec4($0.xyz, 1.0)"},
    {"ND_convert_vector2_vector3", "vec4($0.xy, 0.0, 0.0)"},
    {"ND_convert_float_integer", "floor($0)"},
    {"ND_combine2_vector2", "vec4($0.x, $1.x, 0.0, 0.0)"},
    {"ND_combine3_color3", "vec4($0.x, $1.x, $2.x, 0.0)"},
    {"ND_combine4_color4", "vec4($0.x, $1.x, $2.x, $3.x)"},
    {"ND_combine2_color4CF", "vec4($0.xyz, $1.x)"},
    {"ND_combine2_vector4VV", "vec4($0.xy, $1.xy)"},
    {"ND_extract_color3", "vec4($0[clamp(int($1.x), 0, $s - 1)])"},
    {"ND_separate4_color4", "vec4($0.x); vec4($0.y); vec4($0.z); vec4($0.w)"},

    {"ND_ifgreater_float", "$0.x > $1.x ? $2 : $3"},
    {"ND_ifgreatereq_float", "$0.x >= $1.x ? $2 : $3"},
    {"ND_ifequal_float", "$0.x == $1.x ? $2 : $3"},
    {"ND_ifgreater_boolean", "vec4($0.x > $1.x ? 1.0 : 0.0)"},
    {"ND_ifgreatereq_boolean", "vec4($0.x >= $1.x ? 1.0 : 0.0)"},
    {"ND_ifequal_boolean", "vec4($0.x == $1.x ? 1.0 : 0.0)"},
    {"ND_logical_and", "vec4($0.x != 0.0 && $1.x != 0.0 ? 1.0 : 0.0)"},
    {"ND_logical_or", "vec4($0.x != 0.0 || $1.x != 0.0 ? 1.0 : 0.0)"},
    {"ND_logical_not", "vec4($0.x == 0.0 ? 1.0 : 0.0)"},

    {"ND_roughness_anisotropy", "vec4(patternRoughnessAnisotropy($0.x, $1.x), 0.0, 0.0)"},
    {"ND_roughness_dual", "vec4(patternRoughnessDual($0.xy), 0.0, 0.0)"},
    {"ND_glossiness_anisotropy", "vec4(patternRoughnessAnisotropy(1.0 - $0.x, $1.x), 0.0, 0.0)"},
    {"ND_artistic_ior", "nodeArtisticIor($0, $1); nodeArtisticExtinction($0, $1)"},
    {"ND_blackbody", "vec4(patternBlackbody($0.x), 0.0)"},

    {"ND_contrast_color3", "($0 - $2) * $1 + $2"},
    {"ND_hsvadjust_color3", "vec4(patternHsvAdjust($0.xyz, $1.xyz), $0.w)"},
    {"ND_saturate_color3", "vec4(patternSaturate($0.xyz, $1.x, $2.xyz), $0.w)"},
    {"ND_premult_color4", "vec4($0.xyz * $0.w, $0.w)"},
    {"ND_unpremult_color4", "$0.w != 0.0 ? vec4($0.xyz / $0.w, $0.w) : vec4(0.0)"},
    {"ND_plus_color3", "$1 + $0 * $2.x"},
    {"ND_minus_color3", "$1 - $0 * $2.x"},
    {"ND_screen_color3", "$1 + ($0 - $0 * $1) * $2.x"},
    {"ND_difference_color3", "$1 + (abs($1 - $0) - $1) * $2.x"},
    {"ND_inside_color3", "$0 * $1.x"},
    {"ND_outside_color3", "$0 * (1.0 - $1.x)"},

    {"ND_position_vector3", "nodePosition($m)"},
    {"ND_normal_vector3", "nodeNormal($m, point.normal)"},
    {"ND_tangent_vector3", "nodeTangent($m, point.tangent)"},
    {"ND_bitangent_vector3", "nodeTangent($m, point.bitangent)"},
    {"ND_viewdirection_vector3", "nodeTangent($m, point.view)"},
    {"PatinaBackSide", "vec4(dot(point.view, point.geometricNormal) < 0.0 ? 1.0 : 0.0)"},
    {"ND_texcoord_vector2", "vec4(primvar($p, vec4(0.0)).xyz, 0.0)"},
    {"ND_geomcolor_color3", "primvar($p, vec4(0.0, 0.0, 0.0, 1.0))"},
    {"ND_geomcolor_float", "vec4(primvar($p, vec4(0.0)).x)"},
    {"ND_geompropvalue_float", "vec4(primvar($p, $1).x)"},
    {"ND_geompropvalue_color3", "primvar($p, $1)"},

    {"ND_image_float", "vec4($t($2.xy, point.uvFootprint).x)"},
    {"ND_image_color3", "$t($2.xy, point.uvFootprint)"},
    {"ND_tiledimage_float", "vec4($t(nodeTiledUv($2, $3, $4, $5, $6), nodeTiledFootprint($3)).x)"},
    {"ND_tiledimage_color3", "$t(nodeTiledUv($2, $3, $4, $5, $6), nodeTiledFootprint($3))"},

    {"ND_noise2d_float", "vec4(noisePerlin2($2.xy, 0) * $0.x + $1.x)"},
    {"ND_noise2d_color3", "nodeNoise2($2.xy) * $0 + $1.x"},
    {"ND_noise3d_float", "vec4(noisePerlin3($2.xyz, 0) * $0.x + $1.x)"},
    {"ND_noise3d_color3", "nodeNoise3($2.xyz) * $0 + $1.x"},
    {"ND_fractal2d_float", "vec4(noiseFractal2($4.xy, int($1.x), $2.x, $3.x, 0) * $0.x)"},
    {"ND_fractal3d_float", "vec4(noiseFractal3($4.xyz, int($1.x), $2.x, $3.x, 0) * $0.x)"},
    {"ND_fractal2d_color3", "nodeFractal2($4.xy, int($1.x), $2.x, $3.x) * $0"},
    {"ND_fractal3d_color3", "nodeFractal3($4.xyz, int($1.x), $2.x, $3.x) * $0"},
    {"ND_cellnoise2d_float", "vec4(noiseCell2($0.xy))"},
    {"ND_cellnoise3d_float", "vec4(noiseCell3($0.xyz))"},
    {"ND_worleynoise2d_float", "vec4(worleyScalar2($0.xy, $1.x, int($2.x)))"},
    {"ND_worleynoise2d_vector3", "vec4(worleyNoise2($0.xy, $1.x, int($2.x)), 0.0)"},
    {"ND_worleynoise3d_float", "vec4(worleyScalar3($0.xyz, $1.x, int($2.x)))"},
    {"ND_worleynoise3d_vector3", "vec4(worleyNoise3($0.xyz, $1.x, int($2.x)), 0.0)"},
    {"ND_checkerboard_color3", "$1 + ($0 - $1) * patternChecker(patternTile($4.xy, $2.xy, $3.xy))"},
    {"ND_circle_float", "vec4(patternShape(0, $0.xy - $1.xy, $2.x))"},
    {"ND_cloverleaf_float", "vec4(patternShape(1, $0.xy - $1.xy, $2.x))"},
    {"ND_hexagon_float", "vec4(patternShape(2, $0.xy - $1.xy, $2.x))"},
    {"ND_tiledcircles_color3", "nodeTiledShape(0, 0.866025, $0, $1, $2, $3, $4)"},
    {"ND_tiledcloverleafs_color3", "nodeTiledShape(1, 0.5, $0, $1, $2, $3, $4)"},
    {"ND_tiledhexagons_color3", "nodeTiledShape(2, 0.866025, $0, $1, $2, $3, $4)"},
    {"ND_line_float", "vec4(patternLine($0.xy - $1.xy, $3.xy, $4.xy, $2.x))"},
    {"ND_grid_color3", "vec4(patternGrid(patternTile($0.xy, $1.xy, $2.xy), $3.x, $4.x != 0.0))"},
    {"ND_crosshatch_color3",
     "vec4(patternCrosshatch(patternTile($0.xy, $1.xy, $2.xy), $3.x, $4.x != 0.0))"},
    {"ND_ramplr_float", "$0 + ($1 - $0) * clamp($2.x, 0.0, 1.0)"},
    {"ND_ramptb_float", "$1 + ($0 - $1) * clamp($2.y, 0.0, 1.0)"},
    {"ND_ramp4_float", "nodeRamp4($0, $1, $2, $3, $4.xy)"},
    {"ND_splitlr_float", "$3.x >= $2.x ? $1 : $0"},
    {"ND_splittb_float", "$3.y >= $2.x ? $0 : $1"},
};

const std::unordered_map<void*, const char*>& table() {
    static const auto made = [] {
        std::unordered_map<void*, const char*> t;
        for (const Row& row : rows) {
            const NodeDef* def = NodeTable::get().find(row.id);
            if (def && def->function) t[reinterpret_cast<void*>(def->function)] = row.text;
        }
        return t;
    }();
    return made;
}

PatternFunction functionOf(const char* id) {
    const NodeDef* def = NodeTable::get().find(id);
    return def ? def->function : nullptr;
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    size_t from = 0;
    while (from <= text.size()) {
        size_t to = text.find(';', from);
        if (to == std::string::npos) to = text.size();
        parts.push_back(text.substr(text[from] == ' ' ? from + 1 : from, to - from));
        from = to + 1;
    }
    return parts;
}

} // namespace

std::vector<std::string> glslPattern(const Instruction& instruction,
                                     const std::function<std::string(int)>& inputText,
                                     const std::function<std::string(int)>& sampler) {
    // An input that is read twice is one and the same constant.
    std::map<int, std::string> known;
    const auto input = [&](int i) {
        const auto found = known.find(i);
        return found != known.end() ? found->second : known[i] = inputText(i);
    };
    const PatternData& data = instruction.data;
    static const PatternFunction uvTexture = functionOf("UsdUVTexture");
    if (instruction.function == uvTexture) {
        if (data.handle < 0) {
            const std::string f = input(4);
            return {"vec4(" + f + ".x)",
                    "vec4(" + f + ".y)",
                    "vec4(" + f + ".z)",
                    "vec4(" + f + ".w)",
                    f,
                    f};
        }
        std::string t = "(" + sampler(data.handle) + "(";
        t += input(1) + ".xy, point.uvFootprint) * ";
        t += input(2) + " + ";
        t += input(3) + ")";
        return {"vec4(" + t + ".x)",
                "vec4(" + t + ".y)",
                "vec4(" + t + ".z)",
                "vec4(" + t + ".w)",
                t,
                t};
    }
    const auto found = table().find(reinterpret_cast<void*>(instruction.function));
    if (found == table().end()) return {};
    const char* text = found->second;
    std::string out;
    for (const char* c = text; *c; ++c) {
        if (*c != '$') {
            out += *c;
            continue;
        }
        ++c;
        if (std::isdigit(static_cast<unsigned char>(*c)))
            out += input(*c - '0');
        else if (*c == 's')
            out += std::to_string(data.size);
        else if (*c == 'm')
            out += std::to_string(data.mode);
        else if (*c == 'p')
            out += std::to_string(data.slot);
        else if (data.handle < 0)
            return {input(1)}; // the input `default` of image nodes
        else
            out += sampler(data.handle);
    }
    std::vector<std::string> outputs = split(out);
    static const PatternFunction separate = functionOf("ND_separate4_color4");
    if (instruction.function == separate) outputs.resize(size_t(data.size));
    return outputs;
}

} // namespace patina
