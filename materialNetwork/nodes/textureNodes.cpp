// SPDX-License-Identifier: Apache-2.0
// MaterialX image nodes.
#include "materialNetwork/nodes/imageSetup.h"
#include "materialNetwork/nodes/nodeTable.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using glm::vec2;
using glm::vec4;
using Call = const PatternCall&;

TextureWrap addressMode(PatternSetup& setup, const char* input) {
    const std::string mode = setup.text(input);
    if (mode == "constant") return TextureWrap::Black;
    if (mode == "clamp") return TextureWrap::Clamp;
    if (mode == "mirror") return TextureWrap::Mirror;
    if (mode != "periodic" && !mode.empty())
        setup.warn(input, "unknown address mode '" + mode + "'; periodic is used");
    return TextureWrap::Repeat;
}

void write(Call c, vec2 uv, float footprint) {
    if (c.data.handle < 0) {
        c.out() = c.in(1);
        return;
    }
    const vec4 t = c.context.textures->sample(c.data.handle, uv, footprint);
    c.out() = t;
}

void writeScalar(Call c, vec2 uv, float footprint) {
    write(c, uv, footprint);
    c.out() = vec4(c.out().x);
}

vec2 tiledUv(Call c) {
    const vec2 image(c.in(5)), tile(c.in(6));
    const vec2 uv = vec2(c.in(2)) * vec2(c.in(3)) - vec2(c.in(4));
    return vec2(image.x != 0.0f ? uv.x / image.x * tile.x : 0.0f,
                image.y != 0.0f ? uv.y / image.y * tile.y : 0.0f);
}

float tiledFootprint(Call c) {
    const vec2 scale = glm::abs(vec2(c.in(3)));
    return c.point().uvFootprint * std::max(scale.x, scale.y);
}

constexpr Pattern imageTuple = pattern(
    "$t($2.xy, point.uvFootprint)", [](Call c) { write(c, vec2(c.in(2)), c.point().uvFootprint); });
constexpr Pattern imageScalar = pattern("vec4($t($2.xy, point.uvFootprint).x)", [](Call c) {
    writeScalar(c, vec2(c.in(2)), c.point().uvFootprint);
});

constexpr Pattern tiledTuple =
    pattern("$t(nodeTiledUv($2, $3, $4, $5, $6), nodeTiledFootprint($3))",
            [](Call c) { write(c, tiledUv(c), tiledFootprint(c)); });
constexpr Pattern tiledScalar =
    pattern("vec4($t(nodeTiledUv($2, $3, $4, $5, $6), nodeTiledFootprint($3)).x)",
            [](Call c) { writeScalar(c, tiledUv(c), tiledFootprint(c)); });

#define PATINA_IMAGE "filename file=, $ default=0, vector2 texcoord=@UV0, "
#define PATINA_ADDRESS                                                                             \
    "string uaddressmode=periodic, string vaddressmode=periodic, string filtertype=linear"
// Sequences and layers of images are not read; the inputs are known so that documents may have
// them.
#define PATINA_FRAMES                                                                              \
    ", string layer=, string framerange=, integer frameoffset=0, string frameendaction=constant"
#define PATINA_TILED                                                                               \
    PATINA_IMAGE "vector2 uvtiling=1, vector2 uvoffset=0, vector2 realworldimagesize=1, "          \
                 "vector2 realworldtilesize=1, string filtertype=linear, "                         \
                 "string uaddressmode=periodic, string vaddressmode=periodic" PATINA_FRAMES

const NodeRow rows[] = {
    {"ND_image_float", "image",
     "filename file=, float default=0, vector2 texcoord=@UV0, " PATINA_ADDRESS PATINA_FRAMES,
     "float", imageScalar, Algebra::None, nullptr, prepareImage, true},
    {"ND_image_$", "image", PATINA_IMAGE PATINA_ADDRESS PATINA_FRAMES, "$", imageTuple,
     Algebra::None, tupleTypes, prepareImage, true},
    {"ND_tiledimage_$", "tiledimage", PATINA_TILED, "$", tiledScalar, Algebra::None, "float",
     prepareImage, true},
    {"ND_tiledimage_$", "tiledimage", PATINA_TILED, "$", tiledTuple, Algebra::None, tupleTypes,
     prepareImage, true},
};

} // namespace

int openImage(PatternSetup& setup, const char* input) {
    TextureRequest request;
    const Value* file = setup.constant(input);
    if (!file) {
        setup.warn(input, "the file name varies over the surface; the default is used");
        return -1;
    }
    if (file->text.empty()) {
        setup.warn(input, "no file is given; the default is used");
        return -1;
    }
    request.file = file->text;
    request.colorSpace = file->colorSpace.empty() ? "raw" : file->colorSpace;
    request.wrapS = addressMode(setup, "uaddressmode");
    request.wrapT = addressMode(setup, "vaddressmode");
    request.nearest = setup.text("filtertype") == "closest";
    request.input = input;
    if (!setup.text("layer").empty() || !setup.text("framerange").empty())
        setup.warn(input, "layers and frame ranges of images are not read; the file as it is named "
                          "is used");
    const int handle = setup.openTexture(request);
    // Without an authored default the source's own sign of a missing texture shows.
    return setup.textureValid(handle) || !setup.authored("default") ? handle : -1;
}

void prepareImage(PatternSetup& setup, PatternData& data) {
    data.handle = openImage(setup, "file");
}

NodeRows textureNodes() {
    return {std::begin(rows), std::end(rows)};
}

} // namespace patina
