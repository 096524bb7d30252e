// SPDX-License-Identifier: Apache-2.0
// Nodes that read the surface or images: spaces, slopes, placed images.
#include "materialNetwork/tests/patternFixture.h"

namespace patina {

namespace {

/// An object that is stretched by (2, 3, 4) and moved by (10, 20, 30); its point (1, 1, 1).
ShadingPoint stretched() {
    ShadingPoint p;
    p.objectPosition = glm::vec3(1.0f);
    p.position = {12, 23, 34};
    p.objectToWorldNormal = glm::mat3(0.5f, 0, 0, 0, 1 / 3.0f, 0, 0, 0, 0.25f);
    return p;
}

glm::vec3 transformed(const char* id, const glm::vec3& v, const char* from, const char* to) {
    return emitted(emitting({makeNode("x", id,
                                      {{"in", Value::makeVec3(v.x, v.y, v.z)},
                                       {"fromspace", text(from)},
                                       {"tospace", text(to)}})}),
                   stretched());
}

/// The value of an image node: FakeTextures return the place where they are read.
glm::vec3 shown(const std::string& id, Inputs inputs, const std::string& output,
                const glm::vec2& uv, ShadingPoint point = {}) {
    inputs["file"] = Value::makeFilename("a.png");
    return emitted(emitting({makeNode("x", id, std::move(inputs))}, output), point,
                   {{"st", glm::vec4(uv, 0, 0)}});
}

} // namespace

TEST(SurfacePatterns, Spaces) {
    expectVector(transformed("ND_transformpoint_vector3", {1, 2, 3}, "object", "world"), 12, 26,
                 42);
    expectVector(transformed("ND_transformpoint_vector3", {12, 26, 42}, "world", "object"), 1, 2, 3,
                 1e-4f);
    expectVector(transformed("ND_transformpoint_vector3", {1, 2, 3}, "world", "world"), 1, 2, 3);
    expectVector(transformed("ND_transformvector_vector3", {1, 2, 3}, "object", "world"), 2, 6, 12);
    expectVector(transformed("ND_transformvector_vector3", {2, 6, 12}, "world", "model"), 1, 2, 3);
    const float k = 1.0f / std::sqrt(0.25f + 1 / 9.0f);
    expectVector(transformed("ND_transformnormal_vector3", {1, 1, 0}, "object", "world"), 0.5f * k,
                 k / 3, 0);
}

TEST(SurfacePatterns, FacingRatio) {
    ShadingPoint p;
    p.viewDirection = direction(60.0f);
    const auto facing = [&](bool invert) {
        return emitted(
                   emitting({makeNode("f", "ND_facingratio_float",
                                      {{"invert", Value::makeBool(invert)}}),
                             makeNode("x", "ND_convert_float_color3", {}, {{"in", {"f", ""}}})}),
                   p)
            .x;
    };
    EXPECT_NEAR(facing(false), 0.5f, 1e-5f);
    EXPECT_NEAR(facing(true), 0.5f, 1e-5f);
    p.viewDirection = direction(0.0f);
    EXPECT_NEAR(facing(true), 0.0f, 1e-5f);
}

// The height 0.25 u: its slope, by the factor 1/16 of MaterialX's Sobel filter.
TEST(SurfacePatterns, HeightsGiveNormals) {
    const auto nodes = [](const char* id, const char* input) {
        return std::vector<NetworkNode>{
            makeNode("uv", "ND_texcoord_vector2"),
            makeNode("u", "ND_separate2_vector2", {}, {{"in", {"uv", ""}}}),
            makeNode("h", "ND_multiply_float", {{"in2", number(4.0f)}}, {{"in1", {"u", "outx"}}}),
            makeNode("x", id, {{"scale", number(2.0f)}}, {{input, {"h", ""}}})};
    };
    ShadingPoint p;
    const glm::vec3 n = emitted(emitting(nodes("ND_heighttonormal_vector3", "in")), p,
                                {{"st", glm::vec4(0.25f, 0.5f, 0, 0)}});
    const float slope = 4.0f * 2.0f / 16.0f, length = std::sqrt(1 + slope * slope);
    expectVector(n, 0.5f - 0.5f * slope / length, 0.5f, 0.5f + 0.5f / length, 1e-3f);
    // Over coordinates that run twice as fast the same height is half as steep.
    auto over = nodes("ND_heighttonormal_vector3", "in");
    over.push_back(
        makeNode("fast", "ND_multiply_vector2FA", {{"in2", number(2.0f)}}, {{"in1", {"uv", ""}}}));
    over[3].connections["texcoord"] = {"/m/fast", ""};
    const glm::vec3 slower = emitted(emitting(over), p, {{"st", glm::vec4(0.25f, 0.5f, 0, 0)}});
    const float half = 0.5f * slope, halfLength = std::sqrt(1 + half * half);
    expectVector(slower, 0.5f - 0.5f * half / halfLength, 0.5f, 0.5f + 0.5f / halfLength, 1e-3f);
    // A height that is the same everywhere is flat.
    expectVector(emitted(emitting({makeNode("x", "ND_heighttonormal_vector3",
                                            {{"in", number(3.0f)}, {"scale", number(2.0f)}})})),
                 0.5f, 0.5f, 1);
    // bump scales its slope and bends the normal against it.
    p.normal = {0, 0, 1};
    const glm::vec3 bent = emitted(emitting(nodes("ND_bump_vector3", "height")), p,
                                   {{"st", glm::vec4(0.25f, 0.5f, 0, 0)}});
    EXPECT_NEAR(bent.z, 1.0f / std::sqrt(1 + slope * slope), 2e-3f);
}

TEST(SurfacePatterns, HeightsOfImagesAndPositions) {
    // FakeTextures give (u, v, 0.5): a slope along u and along v.
    const glm::vec3 n =
        emitted(emitting({makeNode("i", "ND_image_float", {{"file", Value::makeFilename("a.png")}}),
                          makeNode("x", "ND_heighttonormal_vector3", {{"scale", number(16.0f)}},
                                   {{"in", {"i", ""}}})}),
                {}, {{"st", glm::vec4(0.25f, 0.5f, 0, 0)}});
    expectVector(n, 0.5f - 0.5f / std::sqrt(2.0f), 0.5f, 0.5f + 0.5f / std::sqrt(2.0f), 1e-3f);
    // Two world units per unit of uv, along y: the height y rises by 2 per unit of v.
    ShadingPoint p;
    p.lengthPerUv = 2.0f;
    const glm::vec3 m =
        emitted(emitting({makeNode("p", "ND_position_vector3", {{"space", text("world")}}),
                          makeNode("y", "ND_extract_vector3", {{"index", Value::makeInt(1)}},
                                   {{"in", {"p", ""}}}),
                          makeNode("x", "ND_heighttonormal_vector3", {{"scale", number(8.0f)}},
                                   {{"in", {"y", ""}}})}),
                p);
    expectVector(m, 0.5f, 0.5f - 0.5f / std::sqrt(2.0f), 0.5f + 0.5f / std::sqrt(2.0f), 1e-3f);
}

TEST(SurfacePatterns, GltfImagesArePlacedAsGltfSays) {
    const glm::vec2 uv(0.25f, 0.5f);
    expectVector(shown("ND_gltf_image_color3_color3_1_0", {{"factor", color(2, 4, 1)}}, "", uv),
                 0.5f, 2.0f, 0.5f);
    // KHR_texture_transform scales about the upper left corner, where v is 1 in USD.
    expectVector(
        shown("ND_gltf_image_color3_color3_1_0", {{"scale", Value::makeVec2(2, 1.5f)}}, "", uv),
        0.5f, 0.25f, 0.5f);
    expectVector(
        shown("ND_gltf_image_color3_color3_1_0", {{"offset", Value::makeVec2(0.1f, 0.2f)}}, "", uv),
        0.35f, 0.3f, 0.5f);
    expectVector(shown("ND_gltf_colorimage", {}, "outcolor", uv), 0.25f, 0.5f, 0.5f);
    // A missing image shows the default.
    expectVector(emitted(emitting({makeNode("x", "ND_triplanarprojection_color3",
                                            {{"filex", Value::makeFilename("a.png")},
                                             {"filey", Value::makeFilename("b.png")},
                                             {"filez", Value::makeFilename("c.png")},
                                             {"position", Value::makeVec3(0.1f, 0.2f, 0.3f)},
                                             {"normal", Value::makeVec3(0, 0, -2)}})})),
                 0.1f, 0.2f, 0.5f);
}

/// Outside of 0 to 1 an image whose address mode is "constant" is the node's default.
TEST(SurfacePatterns, ImagesEnd) {
    for (const char* id :
         {"ND_image_color3", "ND_tiledimage_color3", "ND_gltf_image_color3_color3_1_0"}) {
        SCOPED_TRACE(id);
        const auto at = [&](const char* u, const char* v, const glm::vec2& uv, float width = 0.0f) {
            ShadingPoint point;
            point.uvFootprint = width;
            return shown(id,
                         {{"default", color(0.1f, 0.6f, 0.3f)},
                          {"uaddressmode", text(u)},
                          {"vaddressmode", text(v)}},
                         "", uv, point);
        };
        expectVector(at("constant", "constant", {0.25f, 0.75f}), 0.25f, 0.75f, 0.5f);
        expectVector(at("constant", "periodic", {1.25f, 0.75f}), 0.1f, 0.6f, 0.3f);
        expectVector(at("clamp", "constant", {0.25f, -0.5f}), 0.1f, 0.6f, 0.3f);
        expectVector(at("constant", "periodic", {0.25f, 1.5f}), 0.25f, 1.5f, 0.5f);
        // Half of the filter lies outside.
        expectVector(at("constant", "clamp", {1.0f, 0.5f}, 0.1f), 0.55f, 0.55f, 0.4f);
    }
    // Tiles have no outside; MaterialX's UsdUVTexture ends at its fallback.
    Inputs inputs = {{"uaddressmode", text("constant")},
                     {"file", Value::makeFilename("a.<UDIM>.png")}};
    expectVector(emitted(emitting({makeNode("x", "ND_image_color3", inputs)}), {},
                         {{"st", {1.25f, 0.5f, 0, 0}}}),
                 1.25f, 0.5f, 0.5f);
    Value fallback;
    fallback.type = ValueType::Color4;
    fallback.numbers = {0.2f, 0.4f, 0.6f, 1.0f};
    expectVector(shown("ND_UsdUVTexture_23", {{"wrapS", text("constant")}, {"fallback", fallback}},
                       "rgb", {1.5f, 0.5f}),
                 0.2f, 0.4f, 0.6f);
}

TEST(SurfacePatterns, TriplanarBlendsByTheNormal) {
    const auto at = [](float blend) {
        return emitted(emitting({makeNode("x", "ND_triplanarprojection_color3",
                                          {{"filex", Value::makeFilename("a.png")},
                                           {"filey", Value::makeFilename("b.png")},
                                           {"filez", Value::makeFilename("c.png")},
                                           {"blend", number(blend)},
                                           {"position", Value::makeVec3(0.1f, 0.2f, 0.3f)},
                                           {"normal", Value::makeVec3(0.25f, 0, 0.75f)}})}));
    };
    // x shows (y, z), z shows (x, y); shares 1/4 and 3/4, then by the square 1/10 and 9/10.
    expectVector(at(1.0f), 0.25f * 0.2f + 0.75f * 0.1f, 0.25f * 0.3f + 0.75f * 0.2f, 0.5f);
    expectVector(at(0.5f), 0.1f * 0.2f + 0.9f * 0.1f, 0.1f * 0.3f + 0.9f * 0.2f, 0.5f);
}

TEST(SurfacePatterns, LatLongImages) {
    const auto look = [](float x, float y, float z) {
        return shown("ND_latlongimage", {{"viewdir", Value::makeVec3(x, y, z)}}, "", {});
    };
    expectVector(look(0, 0, 1), 0.5f, 0.5f, 0.5f);
    expectVector(look(1, 0, 0), 0.25f, 0.5f, 0.5f);
    expectVector(look(-1, 0, 0), 0.75f, 0.5f, 0.5f);
    EXPECT_NEAR(look(0, 1, 0).y, 1.0f, 1e-5f);
}

// With nothing random about the tiles, hex tiling shows the image as it is.
TEST(SurfacePatterns, HexTilesWithoutSpreadAreTheImage) {
    const glm::vec2 uv(0.37f, 0.61f);
    expectVector(shown("ND_hextiledimage_color3",
                       {{"rotation", number(0)},
                        {"scale", number(0)},
                        {"offset", number(0)},
                        {"rotationrange", Value::makeVec2(0, 0)},
                        {"offsetrange", Value::makeVec2(0, 0)},
                        {"tiling", Value::makeVec2(2, 3)}},
                       "", uv),
                 0.74f, 1.83f, 0.5f, 1e-4f);
}

} // namespace patina
