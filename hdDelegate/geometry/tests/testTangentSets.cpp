// SPDX-License-Identifier: Apache-2.0
// The uv set that tangents follow on a mesh, and those that a material asks for by name.

#include "hdDelegate/geometry/displace.h"
#include "hdDelegate/geometry/tangentFrames.h"
#include "materialNetwork/shadingPoint.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

using Rate = MeshAttribute::Rate;

MeshAttribute attribute(const std::string& name, Rate rate, int components,
                        std::vector<float> data = {}) {
    return {name, components, rate, std::move(data)};
}

/// The square from (-1, -1) to (1, 1), with a set that runs along it and one that is turned to the
/// left by a quarter and mirrored where asked.
TriangleMesh square(bool mirrored) {
    TriangleMesh mesh;
    mesh.positions = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
    mesh.triangles = {uvec3(0, 1, 2), uvec3(0, 2, 3)};
    mesh.triangleFace = {0, 0};
    std::vector<float> st, turned;
    for (const vec3& p : mesh.positions[0]) {
        st.insert(st.end(), {p.x, p.y});
        turned.insert(turned.end(), {p.y, mirrored ? p.x : -p.x});
    }
    mesh.attributes = {attribute("st", Rate::PerVertex, 2, st),
                       attribute("turned", Rate::PerVertex, 2, turned)};
    return mesh;
}

} // namespace

TEST(TangentSets, AreTheOneThatIsWantedOrTheUsualOrTheFirst) {
    std::vector<MeshAttribute> list = {
        attribute("b", Rate::PerCorner, 2), attribute("a", Rate::PerVertex, 2),
        attribute("A", Rate::PerFace, 2), attribute("displayColor", Rate::PerVertex, 3),
        attribute("0", Rate::Constant, 2)};
    EXPECT_EQ(tangentSet(list, "b"), 0);
    EXPECT_EQ(tangentSet(list, "st"), 1);
    EXPECT_EQ(tangentSet(list, "0"), 1);
    for (const char* usual : {"map1", "UVMap", "uv", "st"}) {
        list.push_back(attribute(usual, Rate::PerCorner, 2));
        EXPECT_EQ(tangentSet(list, "none"), int(list.size()) - 1) << usual;
    }
    EXPECT_EQ(tangentSet(std::vector<MeshAttribute>(), "st"), -1);
}

TEST(TangentSets, PrimvarsOfTangentsAreDerivatives) {
    for (const bool mirrored : {false, true}) {
        const TriangleMesh mesh = square(mirrored);
        float out[4];
        for (unsigned t = 0; t < 2; ++t) {
            ASSERT_TRUE(MeshPrimvar(mesh, tangentPrimvar("turned")).read(mesh, t, 0.2f, 0.3f, out));
            EXPECT_EQ(vec4(out[0], out[1], out[2], out[3]), vec4(0, 1, 0, mirrored ? -1.0f : 1.0f));
        }
        EXPECT_FALSE(MeshPrimvar(mesh, tangentPrimvar("none")).read(mesh, 0, 0, 0, out));
    }
}

/// Each place moves by its coordinates along the tangents of the set that they are read from: all
/// of it becomes twice as large, whichever set that is.
TEST(TangentSets, DisplacementAlongTangents) {
    for (const char* set : {"st", "turned"})
        for (const bool mirrored : {false, true}) {
            Network network = makeNetwork(
                {makeNode("read", "ND_geompropvalue_vector2", {{"geomprop", text(set)}}),
                 makeNode("widen", "ND_convert_vector2_vector3", {}, {{"in", {"read", ""}}}),
                 makeNode("displacement", "ND_displacement_vector3", {},
                          {{"displacement", {"widen", ""}}}),
                 makeNode("surface", "ND_surface")});
            network.terminals["displacement"] = {"/m/displacement", ""};
            TriangleMesh mesh = square(mirrored);
            const std::vector<vec3> before = mesh.positions[0];
            displace(mesh, {Compiled(network).program}, mat4(1.0f));
            for (size_t i = 0; i < before.size(); ++i) {
                EXPECT_NEAR(mesh.positions[0][i].x, 2.0f * before[i].x, 1e-5f) << set;
                EXPECT_NEAR(mesh.positions[0][i].y, 2.0f * before[i].y, 1e-5f) << set;
            }
        }
}
