# SPDX-License-Identifier: Apache-2.0
"""Where MaterialX's own library calls a node otherwise than networks do, and what its nodes cannot take.

Sources: the nodedefs of MaterialX 1.39 (`bxdf/usd_preview_surface.mtlx`, `pbrlib`), and UsdPreviewSurface's specification of
wrap modes and colour spaces.
"""

RENAMED = {  # id of a node -> category and nodedef
    "UsdUVTexture": ("UsdUVTexture", "ND_UsdUVTexture_23"),
    "ND_UsdUVTexture": ("UsdUVTexture", "ND_UsdUVTexture_23"),
    "UsdTransform2d": ("UsdTransform2d", "ND_UsdTransform2d"),
    "UsdPreviewSurface": ("UsdPreviewSurface", "ND_UsdPreviewSurface_surfaceshader"),
    "PatinaCoat": ("layer", "ND_layer_bsdf"),
    "ND_patina_dispersed_ior": ("dot", "ND_dot_float"),
    # Not the node of the same name: that is a graph which some generators cannot follow.
    **{"UsdPrimvarReader_" + usd: ("geompropvalue", "ND_geompropvalue_" + own) for usd, own in (
        ("float", "float"), ("float2", "vector2"), ("float3", "vector3"), ("float4", "vector4"), ("int", "integer"),
        ("string", "string"), ("normal", "vector3"), ("point", "vector3"), ("vector", "vector3"))},
}
SIMPLER = {"PatinaCoat": "coatWrittenAsLayer", "ND_patina_dispersed_ior": "dispersionNotWritten"}  # ids of messages
RENAMED_INPUTS = {"dot": {"ior": "in"}, "geompropvalue": {"varname": "geomprop", "fallback": "default"}}  # of a category
UNKNOWN_INPUTS = {  # nodedef -> inputs that it does not have
    "ND_gltf_normalmap_vector3_1_0": {"normal", "tangent", "bitangent"},
    "ND_UsdUVTexture_23": {"sourceColorSpace"},
    "ND_dot_float": {"abbe_number", "scale"},
}
TEXTURE = "ND_UsdUVTexture_23"
COLOR_SPACES = {"sRGB": "srgb_texture", "raw": "lin_rec709"}  # of sourceColorSpace
CONVERTED = {("float", to) for to in ("color3", "color4", "vector2", "vector3", "vector4")} | {
    ("color3", "vector3"), ("color3", "color4"), ("color3", "vector4"), ("color3", "vector2"), ("color4", "color3"),
    ("color4", "vector4"), ("color4", "vector3"), ("vector2", "vector3"), ("vector3", "color3"), ("vector3", "vector2"),
    ("vector3", "color4"), ("vector3", "vector4"), ("vector4", "color4"), ("vector4", "color3"), ("vector4", "vector3"),
    ("integer", "float"), ("boolean", "float"), ("boolean", "integer")}  # that ND_convert_FROM_TO is there for


def texture_inputs(inputs, outputs_used):
    """Values of USD's UsdUVTexture for which MaterialX's has no word.

    :param inputs: of the node; replaced where the two differ
    :param outputs_used: names of the outputs that others are connected to
    :returns: the inputs
    """
    result = {key: dict(value) for key, value in inputs.items()}
    for key in ("wrapS", "wrapT"):
        word = result.get(key, {"value": "useMetadata"})["value"]
        if word in ("useMetadata", "repeat", "black"):
            result[key] = {"type": "string", "color_space": "", "value": "periodic" if word == "repeat" else "black"}
    space = result.get("sourceColorSpace", {"value": "auto"})["value"]
    file = result.get("file")
    if file and not file["color_space"]:
        eight_bit = str(file["value"]).lower().endswith((".png", ".jpg", ".jpeg", ".tga", ".bmp", ".gif"))
        guess = eight_bit and bool(outputs_used & {"rgb", "rgba", ""})
        file["color_space"] = COLOR_SPACES.get(space, "srgb_texture" if guess else "lin_rec709")
    return result
