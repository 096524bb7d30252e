// SPDX-License-Identifier: Apache-2.0
// Nodes that look at the neighbourhood of a point, against what calculus says.
#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

namespace {

/// "uv", and "square": u * u.
std::vector<NetworkNode> square() {
    return {makeNode("uv", "ND_texcoord_vector2"),
            makeNode("u", "ND_separate2_vector2", {}, {{"in", "uv"}}),
            binaryNode("square", "ND_multiply_float", "u.outx", "u.outx")};
}

float at(std::vector<NetworkNode> nodes, const std::string& last, float u) {
    return emitted(showing(std::move(nodes), last), {}, {{"st", glm::vec4(u, 0, 0, 0)}}).x;
}

/// The mean over samples at one place.
float meanAt(std::vector<NetworkNode> nodes, const std::string& last, float u, int seeds) {
    const Compiled c(showing(std::move(nodes), last));
    EXPECT_TRUE(c->jitters());
    PointWith point(*c.program, {{"st", glm::vec4(u, 0, 0, 0)}});
    double sum = 0.0;
    for (int i = 0; i < seeds; ++i) {
        point.seed = uint32_t(i) + 1;
        sum += double(c->emission(point, {0, 0, 1}).x);
    }
    return float(sum / seeds);
}

NetworkNode blurOf(const std::string& name, const std::string& source, float size,
                   const char* filter = "box") {
    return makeNode(name, "ND_blur_float", {{"size", size}, {"filtertype", filter}},
                    {{"in", source}});
}

} // namespace

TEST(Neighbourhood, BlurIsTheMeanOverASquare) {
    const float u = 0.5f, size = 0.4f;
    auto nodes = square();
    nodes.push_back(blurOf("blur", "square", size));
    // Taps at -2 to 2 fifths of the size: their mean square is 2 / 25.
    EXPECT_NEAR(at(nodes, "blur", u), u * u + size * size * 0.08f, 1e-5f);
    // Blurs add up.
    nodes.push_back(blurOf("second", "blur", 0.2f));
    EXPECT_NEAR(at(nodes, "second", u), u * u + (size * size + 0.04f) * 0.08f, 1e-5f);
    nodes.back() = blurOf("none", "square", 0.0f);
    EXPECT_NEAR(at(nodes, "none", u), u * u, 1e-6f);
}

TEST(Neighbourhood, TapsOfBlursConverge) {
    // Of a step at 0.5, seen over 0.5 around 0.53: 0.28 of 0.5. Taps at the middles of their cells
    // say 0.6 there, and one of five cells' columns is cut, at a fifth of its width.
    std::vector<NetworkNode> nodes = {makeNode("uv", "ND_texcoord_vector2"),
                                      makeNode("u", "ND_separate2_vector2", {}, {{"in", "uv"}}),
                                      makeNode("step", "ND_ifgreater_float",
                                               {{"value2", 0.5f}, {"in1", 1.0f}, {"in2", 0.0f}},
                                               {{"value1", "u.outx"}}),
                                      blurOf("blur", "step", 0.5f)};
    const int seeds = 4096;
    const float column = std::sqrt(0.8f * 0.2f / 5.0f) / 5.0f; // deviation of one sample
    EXPECT_NEAR(meanAt(nodes, "blur", 0.53f, seeds), 0.56f,
                4.5f * column / std::sqrt(float(seeds)));
    EXPECT_NEAR(at(nodes, "blur", 0.53f), 0.6f, 1e-5f); // where nobody has samples

    // A cell adds at most half a fifth of the slope, so that 4.5 deviations are:
    const float size = 0.4f, u = 0.5f;
    const float margin = 4.5f * 2.0f * (u + size) * size / 10.0f / 5.0f / std::sqrt(16384.0f);
    nodes = square();
    nodes.push_back(blurOf("blur", "square", size));
    EXPECT_NEAR(meanAt(nodes, "blur", u, 16384), u * u + size * size / 12.0f, margin);
    // A normal distribution of deviation 0.2, cut off at 2.5 of them.
    nodes.back() = blurOf("blur", "square", size, "gaussian");
    EXPECT_NEAR(meanAt(nodes, "blur", u, 16384), u * u + size * size * 0.04f * 0.91126f, margin);
    // Blurs of blurs move apart: their variances add up.
    nodes.back() = blurOf("blur", "square", size);
    nodes.push_back(blurOf("again", "blur", size));
    EXPECT_NEAR(meanAt(nodes, "again", u, 4096), u * u + size * size / 6.0f, 4.0f * margin);
}

TEST(Neighbourhood, TexturesAndPositionsMove) {
    ShadingPoint point;
    point.tangent = glm::vec3(0, 1, 0);
    point.bitangent = glm::vec3(-1, 0, 0);
    point.lengthPerUv = 3.0f;
    point.position = glm::vec3(0.5f, 0.0f, 0.0f);
    // v runs along -x: the width in the world is 3 times that in uv.
    const std::vector<NetworkNode> nodes = {
        makeNode("p", "ND_position_vector3", {{"space", "world"}}),
        makeNode("parts", "ND_separate3_vector3", {}, {{"in", "p"}}),
        binaryNode("square", "ND_multiply_float", "parts.outx", "parts.outx"),
        blurOf("blur", "square", 0.2f)};
    EXPECT_NEAR(emitted(showing(nodes, "blur"), point).x, 0.25f + 0.36f * 0.08f, 1e-5f);

    Compiled c(emitting({makeNode("image", "ND_image_color3", {{"file", file("a.png")}}),
                         makeNode("x", "ND_blur_color3", {{"size", 0.5f}}, {{"in", "image"}})}));
    EXPECT_EQ(c.textures.requests.size(), 25u);
    expectVector(
        c->emission(PointWith(*c.program, {{"st", glm::vec4(0.3f, 0.6f, 0, 0)}}, point), {0, 0, 1}),
        0.3f, 0.6f, 0.5f);
}

TEST(Neighbourhood, SlopesOfBlursAndOfSlopes) {
    const auto slope = [](std::vector<NetworkNode> nodes, const std::string& height) {
        nodes.push_back(
            makeNode("x", "ND_heighttonormal_vector3", {{"scale", 16.0f}}, {{"in", height}}));
        const glm::vec3 n =
            emitted(emitting(std::move(nodes)), {}, {{"st", glm::vec4(0.25f, 0, 0, 0)}}) * 2.0f -
            1.0f;
        return -n.x / n.z;
    };
    // The slope of u * u is 2 u, and a blur does not change that.
    auto nodes = square();
    nodes.push_back(blurOf("blur", "square", 0.4f));
    for (const char* height : {"square", "blur"})
        EXPECT_NEAR(slope(nodes, height), 0.5f, 2e-3f) << height;
    // The height is a coordinate of another slope's normal.
    nodes.push_back(
        makeNode("first", "ND_heighttonormal_vector3", {{"scale", 16.0f}}, {{"in", "square"}}));
    nodes.push_back(makeNode("parts", "ND_separate3_vector3", {}, {{"in", "first"}}));
    nodes.push_back(makeNode("height", "ND_dot_float", {}, {{"in", "parts.outx"}}));
    // x = -2 u / sqrt(1 + 4 u^2), so half of its slope is -1 / (1 + 4 u^2)^1.5.
    EXPECT_NEAR(slope(nodes, "height"), -std::pow(1.25f, -1.5f), 2e-2f);
}

TEST(Neighbourhood, OddBlursAreReported) {
    auto nodes = square();
    nodes.push_back(blurOf("blur", "square", 0.4f, "median"));
    EXPECT_EQ(warnings(Compiled(showing(nodes, "blur"))),
              "/m/blur [filtertype] 'median' is not known; box is used\n");

    nodes = square();
    for (int i = 0; i < 4; ++i)
        nodes.push_back(blurOf(numbered("blur", i), i ? numbered("blur", i - 1) : "square", 0.1f));
    const Compiled many(showing(nodes, "blur3"));
    EXPECT_TRUE(told(many, "too much would have to be evaluated"));
    EXPECT_NEAR(many->emission(PointWith(*many.program, {{"st", glm::vec4(0.5f)}}), {0, 0, 1}).x,
                0.25f + 2.0f * 0.01f * 0.08f, 1e-4f);
}
