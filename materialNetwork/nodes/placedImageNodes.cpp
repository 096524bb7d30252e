// SPDX-License-Identifier: Apache-2.0
// Image nodes that bring their own placement: glTF's, latitude-longitude maps, three planes.
#define PATINA_NODE_FUNCTIONS "shaders/patterns/nodes/placedImage.glsl"
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"
#include "materialNetwork/nodes/patternFunctions.h"

namespace patina {

namespace {

void prepareTriplanar(PatternSetup& setup, PatternData& data) {
    const char* const files[] = {"filex", "filey", "filez"};
    for (int i = 0; i < 3; ++i)
        data.textures[i] = openImage(setup, files[i]);
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
     "$", PATINA_PATTERN(nodeGltfImage), none, "color3 vector3", prepareImage},
    {"ND_gltf_image_color4_color4_1_0", "gltf_image",
     PATINA_GLTF("color4", "0") "1, color4 factor=1, " PATINA_ADDRESS, "color4",
     PATINA_PATTERN(nodeGltfImage), none, nullptr, prepareImage},
    {"ND_gltf_image_float_float_1_0", "gltf_image",
     PATINA_GLTF("float", "0") "0, float factor=1, " PATINA_ADDRESS, "float",
     PATINA_PATTERN(nodeGltfScalarImage), none, nullptr, prepareImage},
    {"ND_gltf_colorimage", "gltf_colorimage",
     PATINA_GLTF("color4", "0") "1, color4 color=1, color4 geomcolor=1, " PATINA_ADDRESS,
     "color3 outcolor, float outa", PATINA_PATTERN(nodeGltfColorImage), none, nullptr,
     prepareImage},
    {"ND_gltf_normalmap_vector3_1_0", "gltf_normalmap",
     PATINA_GLTF("vector3", "0.5 0.5 1") "0, " PATINA_FRAME PATINA_ADDRESS, "vector3",
     PATINA_PATTERN(nodeGltfNormalMap), none, nullptr, prepareImage},
    {"ND_gltf_iridescence_thickness_float_1_0", "gltf_iridescence_thickness",
     "filename file=, vector3 default=0, vector2 texcoord=@UV0, vector2 pivot=0, vector2 scale=1, "
     "float rotate=0, vector2 offset=0, integer operationorder=0, float thicknessMin=100, "
     "float thicknessMax=400, " PATINA_ADDRESS,
     "float", PATINA_PATTERN(nodeGltfThickness), none, nullptr, prepareImage},
    {"ND_gltf_anisotropy_image", "gltf_anisotropy_image",
     PATINA_GLTF("vector3", "1 0.5 1") "0, float anisotropy_strength=1, "
                                       "float anisotropy_rotation=0, " PATINA_ADDRESS,
     "float anisotropy_strength_out, float anisotropy_rotation_out",
     PATINA_PATTERN(nodeGltfAnisotropy), none, nullptr, prepareImage},
    {"ND_latlongimage", "latlongimage",
     "filename file=, color3 default=0, vector3 viewdir=0 0 1, float rotation=0, "
     "string vaddressmode=mirror",
     "color3", PATINA_PATTERN(nodeLatLongImage), none, nullptr, prepareImage},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$",
     PATINA_PATTERN(nodeScalarTriplanar), none, "float", prepareTriplanar},
    {"ND_triplanarprojection_$", "triplanarprojection", PATINA_TRIPLANAR, "$",
     PATINA_PATTERN(nodeTriplanar), none, tupleTypes, prepareTriplanar},
};

} // namespace

NodeRows placedImageNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
