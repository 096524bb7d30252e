// SPDX-License-Identifier: Apache-2.0
// Tangents follow the uv set that a map is read by.

#include "materialNetwork/tests/patternFixture.h"

using namespace patina;

namespace {

/// A normal map of texels (u, v, 0.5): where it is read at (1, 0.5) the normal is the tangent, at
/// (0.5, 1) the bitangent.
std::vector<NetworkNode> normalMap(const std::string& name, const NetworkNode& texcoord) {
    const std::string output = texcoord.id[0] == 'U' ? "result" : "";
    return {texcoord,
            makeNode(name + "Image", "ND_image_vector3", {{"file", "a.png"}},
                     {{"texcoord", {texcoord.path.substr(3), output}}}),
            makeNode(name, "ND_normalmap_float", {}, {{"in", name + "Image"}})};
}

NetworkNode readerOf(const std::string& set) {
    return makeNode(set, "UsdPrimvarReader_float2", {{"varname", set}});
}

NetworkNode image(const std::string& name, const std::string& set) {
    return makeNode(name, "ND_image_color3", {{"file", name + ".png"}},
                    {{"texcoord", set + ".result"}});
}

/// The sum of two normals, so that both are asked for.
Network sumOf(std::vector<NetworkNode> a, const std::vector<NetworkNode>& b) {
    a.insert(a.end(), b.begin(), b.end());
    a.push_back(binaryNode("sum", "ND_add_vector3", "a", "b"));
    return showing(std::move(a), "sum", "vector3");
}

const glm::vec4 alongU(1.0f, 0.5f, 0.0f, 0.0f), alongV(0.5f, 1.0f, 0.0f, 0.0f);

} // namespace

TEST(TangentSets, ASingleSetIsThatOfTheShadingPoint) {
    const NetworkNode second = makeNode("t", "ND_texcoord_vector2", {{"index", 1.0f}});
    const NetworkNode named = makeNode("t", "ND_geompropvalue_vector2", {{"geomprop", "UVMap"}});
    const std::pair<NetworkNode, std::string> readers[] = {
        {readerOf("st"), "st"}, {readerOf("st1"), "st1"}, {second, "st1"}, {named, "UVMap"}};
    for (const auto& [reader, set] : readers) {
        const Compiled c(showing(normalMap("a", reader), "a", "vector3"));
        EXPECT_EQ(c->tangentSet(), set);
        ASSERT_EQ(c->primvars().size(), 1u);
        EXPECT_EQ(c->primvars()[0].name, set);
    }
    EXPECT_EQ(Compiled(previewNetwork())->tangentSet(), "st");
}

TEST(TangentSets, MapsOfTwoSetsHaveAFrameEach) {
    const Network network = sumOf(normalMap("a", readerOf("st")), normalMap("b", readerOf("st1")));
    EXPECT_EQ(Compiled(network)->tangentSet(), "st");
    const std::string frame = tangentPrimvar("st1");
    ShadingPoint point;
    expectVector(emitted(network, point,
                         {{"st", alongU}, {"st1", alongU}, {frame, glm::vec4(0, 3, 0.5f, 1)}}),
                 1, 1, 0);
    // The bitangent is to the left of the tangent, in mirrored coordinates to the right.
    const std::map<std::string, glm::vec4> mirrored = {
        {"st", alongU}, {"st1", alongV}, {frame, glm::vec4(0, 3, 0, -1)}};
    expectVector(emitted(network, point, mirrored), 2, 0, 0);
    // Transforms that mirror turn it over once more.
    point.objectToWorldNormal = glm::mat3(1, 0, 0, 0, -1, 0, 0, 0, 1);
    expectVector(emitted(network, point, mirrored), 2, 0, 0);
    // Without such a set the frame is that of the point.
    expectVector(emitted(network, {}, {{"st", alongU}, {"st1", alongU}}), 2, 0, 0);
}

TEST(TangentSets, TransformsOfCoordinatesTurnNoFrame) {
    std::vector<NetworkNode> turned = normalMap(
        "b", makeNode("turn", "UsdTransform2d", {{"rotation", 90.0f}}, {{"in", "st1.result"}}));
    turned.push_back(readerOf("st1"));
    const Network network = sumOf(normalMap("a", readerOf("st")), turned);
    // A quarter turn takes (0.5, -1) to (1, 0.5).
    expectVector(emitted(network, {},
                         {{"st", alongU},
                          {"st1", glm::vec4(0.5f, -1.0f, 0, 0)},
                          {tangentPrimvar("st1"), glm::vec4(0, 1, 0, 1)}}),
                 1, 1, 0);
}

TEST(TangentSets, TangentsByIndexAreThoseOfThatSet) {
    const Inputs second = {{"space", "world"}, {"index", 2.0f}};
    const Network network = showing({makeNode("t", "ND_tangent_vector3", second),
                                     makeNode("b", "ND_bitangent_vector3", second),
                                     binaryNode("s", "ND_subtract_vector3", "t", "b")},
                                    "s", "vector3");
    expectVector(emitted(network, {}, {{tangentPrimvar("st2"), {0, 1, 0, 1}}}), 1, 1, 0);
}

/// The direction of a lobe's stretch goes with the normal that it has.
TEST(TangentSets, LobesFollowTheSetOfTheirNormal) {
    std::vector<NetworkNode> nodes = normalMap("n", readerOf("st1"));
    for (const NetworkNode& node :
         {readerOf("st"), image("colour", "st"),
          makeNode(
              "bsdf", "ND_conductor_bsdf",
              {{"ior", grey(0.2f)}, {"extinction", grey(3)}, {"roughness", vector(0.5f, 0.05f)}},
              {{"normal", "n"}}),
          makeNode("edf", "ND_uniform_edf", {}, {{"color", "colour"}})})
        nodes.push_back(node);
    const Compiled c(modelNetwork("ND_surface", {}, {{"bsdf", "bsdf"}, {"edf", "edf"}}, nodes));
    EXPECT_EQ(c->tangentSet(), "st");
    // Up in both frames, stretched along x in the one and along y in the other.
    const auto at = [&](const glm::vec4& frame, const glm::vec3& wi) {
        const PointWith point(
            *c.program,
            {{"st", alongU}, {"st1", {0.5f, 0.5f, 0, 0}}, {tangentPrimvar("st1"), frame}});
        return c.lobes(point).eval(wi).specular.x;
    };
    const float far = at({1, 0, 0, 1}, direction(40.0f)), near = at({0, 1, 0, 1}, direction(40.0f));
    EXPECT_GT(far, 10.0f * near);
    EXPECT_NEAR(at({0, 1, 0, 1}, direction(40.0f, 90.0f)), far, 1e-4f * far);
}

TEST(TangentSets, DisplacementFollowsItsOwnMap) {
    Network network = modelNetwork(
        "ND_surface_unlit", {}, {{"emission_color", "colour"}},
        {readerOf("st"), readerOf("st1"), image("colour", "st"),
         makeNode("height", "ND_image_vector3", {{"file", "c.png"}}, {{"texcoord", "st1.result"}}),
         makeNode("displacement", "ND_displacement_vector3", {}, {{"displacement", "height"}})});
    network.terminals["displacement"] = {"/m/displacement", ""};
    const Compiled c(network);
    EXPECT_EQ(c->tangentSet(), "st");
    EXPECT_EQ(c->displacementSet(), "st1");
}
