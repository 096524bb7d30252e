// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface or images: spaces, slopes, placed images.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

namespace {

/// An object that is stretched by (2, 3, 4) and moved by (10, 20, 30); its point (1, 1, 1).
ShadingPoint stretched() {
    ShadingPoint p;
    p.objectPosition = glm::vec3(1.0f);
    p.position = {12, 23, 34};
    p.objectToWorldNormal = glm::mat3(0.5f, 0, 0, 0, 1 / 3.0f, 0, 0, 0, 0.25f);
    return p;
}

/// @param what a point, vector or normal
glm::vec3 transformed(const std::string& what, const glm::vec3& v, const char* from,
                      const char* to) {
    return emitted(
        emitting({makeNode("x", "ND_transform" + what + "_vector3",
                           {{"in", vector(v.x, v.y, v.z)}, {"fromspace", from}, {"tospace", to}})}),
        stretched());
}

/// A primvar at u and v.
std::map<std::string, glm::vec4> st(float u, float v) {
    return {{"st", glm::vec4(u, v, 0, 0)}};
}

/// The value of an image node: FakeTextures return the place where they are read.
glm::vec3 shown(const std::string& id, Inputs inputs, const glm::vec2& uv,
                const std::string& output = "", const ShadingPoint& point = {}) {
    inputs["file"] = file("a.png");
    return emitted(emitting({makeNode("x", id, inputs)}, output), point, st(uv.x, uv.y));
}

/// The normal that a slope along u makes of z.
glm::vec3 tilted(float slope) {
    return glm::vec3(-slope, 0.0f, 1.0f) / std::sqrt(1.0f + slope * slope);
}

} // namespace

TEST(SurfacePatterns, Spaces) {
    expectVector(transformed("point", {1, 2, 3}, "object", "world"), 12, 26, 42);
    expectVector(transformed("point", {12, 26, 42}, "world", "object"), 1, 2, 3, 1e-4f);
    expectVector(transformed("point", {1, 2, 3}, "world", "world"), 1, 2, 3);
    expectVector(transformed("vector", {1, 2, 3}, "object", "world"), 2, 6, 12);
    expectVector(transformed("vector", {2, 6, 12}, "world", "model"), 1, 2, 3);
    const float k = 1.0f / std::sqrt(0.25f + 1 / 9.0f);
    expectVector(transformed("normal", {1, 1, 0}, "object", "world"), 0.5f * k, k / 3, 0);
}

TEST(SurfacePatterns, FacingRatio) {
    const auto facing = [](float degrees, bool invert) {
        return emitted(showing({makeNode("f", "ND_facingratio_float", {{"invert", invert}})}, "f"),
                       seenFrom(direction(degrees)))
            .x;
    };
    EXPECT_NEAR(facing(60.0f, false), 0.5f, 1e-5f);
    EXPECT_NEAR(facing(60.0f, true), 0.5f, 1e-5f);
    EXPECT_NEAR(facing(0.0f, true), 0.0f, 1e-5f);
}

// The height 0.25 u: its slope, by the factor 1/16 of MaterialX's Sobel filter.
TEST(SurfacePatterns, HeightsGiveNormals) {
    const auto bent = [](const char* id, const char* input, const Connections& over = {}) {
        Connections connections = over;
        connections[input] = "h";
        return emitted(
            emitting({makeNode("uv", "ND_texcoord_vector2"),
                      makeNode("fast", "ND_multiply_vector2FA", {{"in2", 2.0f}}, {{"in1", "uv"}}),
                      makeNode("u", "ND_separate2_vector2", {}, {{"in", "uv"}}),
                      makeNode("h", "ND_multiply_float", {{"in2", 4.0f}}, {{"in1", "u.outx"}}),
                      makeNode("x", id, {{"scale", 2.0f}}, connections)}),
            {}, st(0.25f, 0.5f));
    };
    const float slope = 4.0f * 2.0f / 16.0f;
    expectVector(bent("ND_heighttonormal_vector3", "in"), 0.5f + 0.5f * tilted(slope), 1e-3f);
    // Over coordinates that run twice as fast the same height is half as steep.
    expectVector(bent("ND_heighttonormal_vector3", "in", {{"texcoord", "fast"}}),
                 0.5f + 0.5f * tilted(0.5f * slope), 1e-3f);
    // A height that is the same everywhere is flat.
    expectVector(emitted(emitting({makeNode("x", "ND_heighttonormal_vector3",
                                            {{"in", 3.0f}, {"scale", 2.0f}})})),
                 0.5f, 0.5f, 1);
    // bump scales its slope and bends the normal against it.
    EXPECT_NEAR(bent("ND_bump_vector3", "height").z, tilted(slope).z, 2e-3f);
}

TEST(SurfacePatterns, HeightsOfImagesAndPositions) {
    // FakeTextures give (u, v, 0.5): a slope along u and along v.
    expectVector(emitted(emitting({makeNode("i", "ND_image_float", {{"file", file("a.png")}}),
                                   makeNode("x", "ND_heighttonormal_vector3", {{"scale", 16.0f}},
                                            {{"in", "i"}})}),
                         {}, st(0.25f, 0.5f)),
                 0.5f + 0.5f * tilted(1.0f), 1e-3f);
    // Two world units per unit of uv, along y: the height y rises by 2 per unit of v.
    ShadingPoint p;
    p.lengthPerUv = 2.0f;
    expectVector(
        emitted(emitting(
                    {makeNode("p", "ND_position_vector3", {{"space", "world"}}),
                     makeNode("y", "ND_extract_vector3", {{"index", 1}}, {{"in", "p"}}),
                     makeNode("x", "ND_heighttonormal_vector3", {{"scale", 8.0f}}, {{"in", "y"}})}),
                p),
        0.5f, 0.5f - 0.5f / std::sqrt(2.0f), 0.5f + 0.5f / std::sqrt(2.0f), 1e-3f);
}

TEST(SurfacePatterns, GltfImagesArePlacedAsGltfSays) {
    const char* const id = "ND_gltf_image_color3_color3_1_0";
    const glm::vec2 uv(0.25f, 0.5f);
    expectVector(shown(id, {{"factor", color(2, 4, 1)}}, uv), 0.5f, 2.0f, 0.5f);
    // KHR_texture_transform scales about the upper left corner, where v is 1 in USD.
    expectVector(shown(id, {{"scale", vector(2, 1.5f)}}, uv), 0.5f, 0.25f, 0.5f);
    expectVector(shown(id, {{"offset", vector(0.1f, 0.2f)}}, uv), 0.35f, 0.3f, 0.5f);
    expectVector(shown("ND_gltf_colorimage", {}, uv, "outcolor"), 0.25f, 0.5f, 0.5f);
}

/// Outside of 0 to 1 an image whose address mode is "constant" is the node's default.
TEST(SurfacePatterns, ImagesEnd) {
    for (const char* id :
         {"ND_image_color3", "ND_tiledimage_color3", "ND_gltf_image_color3_color3_1_0"}) {
        SCOPED_TRACE(id);
        const auto at = [&](const char* u, const char* v, const glm::vec2& uv, float width = 0.0f) {
            ShadingPoint point;
            point.uvFootprint = width;
            return shown(
                id,
                {{"default", color(0.1f, 0.6f, 0.3f)}, {"uaddressmode", u}, {"vaddressmode", v}},
                uv, "", point);
        };
        expectVector(at("constant", "constant", {0.25f, 0.75f}), 0.25f, 0.75f, 0.5f);
        expectVector(at("constant", "periodic", {1.25f, 0.75f}), 0.1f, 0.6f, 0.3f);
        expectVector(at("clamp", "constant", {0.25f, -0.5f}), 0.1f, 0.6f, 0.3f);
        expectVector(at("constant", "periodic", {0.25f, 1.5f}), 0.25f, 1.5f, 0.5f);
        // Half of the filter lies outside.
        expectVector(at("constant", "clamp", {1.0f, 0.5f}, 0.1f), 0.55f, 0.55f, 0.4f);
    }
    // Tiles have no outside; MaterialX's UsdUVTexture ends at its fallback.
    const Inputs tiles = {{"uaddressmode", "constant"}, {"file", file("a.<UDIM>.png")}};
    expectVector(emitted(emitting({makeNode("x", "ND_image_color3", tiles)}), {}, st(1.25f, 0.5f)),
                 1.25f, 0.5f, 0.5f);
    expectVector(shown("ND_UsdUVTexture_23",
                       {{"wrapS", "constant"}, {"fallback", color4(0.2f, 0.4f, 0.6f, 1.0f)}},
                       {1.5f, 0.5f}, "rgb"),
                 0.2f, 0.4f, 0.6f);
}

TEST(SurfacePatterns, TriplanarBlendsByTheNormal) {
    const auto at = [](float blend, const Value& normal) {
        return emitted(emitting({makeNode("x", "ND_triplanarprojection_color3",
                                          {{"filex", file("a.png")},
                                           {"filey", file("b.png")},
                                           {"filez", file("c.png")},
                                           {"blend", blend},
                                           {"position", vector(0.1f, 0.2f, 0.3f)},
                                           {"normal", normal}})}));
    };
    expectVector(at(1.0f, vector(0, 0, -2)), 0.1f, 0.2f, 0.5f);
    // x shows (y, z), z shows (x, y); shares 1/4 and 3/4, then by the square 1/10 and 9/10.
    const Value slanted = vector(0.25f, 0, 0.75f);
    expectVector(at(1.0f, slanted), 0.25f * 0.2f + 0.75f * 0.1f, 0.25f * 0.3f + 0.75f * 0.2f, 0.5f);
    expectVector(at(0.5f, slanted), 0.1f * 0.2f + 0.9f * 0.1f, 0.1f * 0.3f + 0.9f * 0.2f, 0.5f);
}

TEST(SurfacePatterns, LatLongImages) {
    const auto look = [](float x, float y, float z) {
        return shown("ND_latlongimage", {{"viewdir", vector(x, y, z)}}, {});
    };
    expectVector(look(0, 0, 1), 0.5f, 0.5f, 0.5f);
    expectVector(look(1, 0, 0), 0.25f, 0.5f, 0.5f);
    expectVector(look(-1, 0, 0), 0.75f, 0.5f, 0.5f);
    EXPECT_NEAR(look(0, 1, 0).y, 1.0f, 1e-5f);
}

// With nothing random about the tiles, hex tiling shows the image as it is.
TEST(SurfacePatterns, HexTilesWithoutSpreadAreTheImage) {
    Inputs inputs = {
        {"rotationrange", vector(0, 0)}, {"offsetrange", vector(0, 0)}, {"tiling", vector(2, 3)}};
    for (const char* name : {"rotation", "scale", "offset"})
        inputs[name] = 0.0f;
    expectVector(shown("ND_hextiledimage_color3", inputs, {0.37f, 0.61f}), 0.74f, 1.83f, 0.5f,
                 1e-4f);
}
