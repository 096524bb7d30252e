// SPDX-License-Identifier: Apache-2.0
// Hair on curves: the lobes of a fibre meet tubes and ribbons with the right frame, place on the
// width and way out.

#include "hdDelegate/embree/media/tests/mediaScene.h"
#include "hdDelegate/scene/tests/prims.h"

#include "shaders/oracle.h"

using namespace patina;
using namespace patina::test;

namespace {

const vec3 pigment(0.1f, 0.4f, 1.2f);

std::vector<NetworkNode> hair(const vec3& absorption) {
    return surfaceOf("ND_chiang_hair_bsdf", {{"absorption_coefficient", vec(absorption)}});
}

/// Strands side by side along x, from -10 to 10. Strand i lies at (y[i], z[i]).
void strands(MediaScene& s, const std::vector<vec2>& at, float radius, CurveBasis basis,
             bool ribbons) {
    auto prim = makePrim<Curves>("/hair");
    prim->basis = basis;
    prim->material = "/m";
    std::vector<vec3> points;
    const int count = basis == CurveBasis::Linear ? 2 : 4;
    for (const vec2& p : at) {
        prim->curveVertexCounts.push_back(count);
        for (int i = 0; i < count; ++i)
            points.push_back(vec3(-10.0f + 20.0f * float(i) / float(count - 1), p.x, p.y));
    }
    prim->primvars = {makePrimvar("widths", Interpolation::Constant, 1, {2.0f * radius})};
    if (ribbons)
        prim->primvars.push_back(makePrimvar("normals", Interpolation::Constant, 3, {0, 0, 1}));
    prim->points = points;
    s.scene->edit().set(prim);
}

/// Mean over the width of a strand seen from its side.
vec3 expected(const vec3& absorption, double edge) {
    const auto l = sh64::chiangHairSetup(sh64::vec3(1.0), sh64::vec3(1.0), sh64::vec3(1.0), 1.55,
                                         sh64::vec2(0.1), sh64::vec2(0.05), sh64::vec2(0.2), 0.5,
                                         sh64::vec3(absorption));
    sh64::vec3 sum(0.0);
    const int n = 2000;
    for (int i = 0; i < n; ++i) {
        const double h = edge * (2.0 * (i + 0.5) / n - 1.0);
        sum += sh64::chiangHairAlbedo(l, sh64::vec3(0.0, h, std::sqrt(1.0 - h * h)));
    }
    return vec3(sum / double(n));
}

} // namespace

// In a white room a strand shows its albedo, which the lobes know in closed form. A strand whose
// light met its own far wall, or whose frame lay across, would show another colour. Four standard
// errors of the image are allowed beside half a percent.
TEST(Fibres, AStrandShowsItsAlbedo) {
    const float edge = 0.96f;
    for (CurveBasis basis : {CurveBasis::Bezier, CurveBasis::Linear})
        for (bool ribbons : {false, true}) {
            if (ribbons && basis == CurveBasis::Linear) continue;
            MediaScene s;
            s.material("/m", hair(pigment));
            strands(s, {vec2(0.0f)}, 0.5f, basis, ribbons);
            s.dome(1.0f);
            s.settings.maxDepth = 16;
            s.camera(vec3(0, 0, 5), 2.0f * 0.5f * edge);
            const auto image = s.render(32, 64);
            const vec3 e = expected(pigment, edge);
            EXPECT_TRUE(image.finite);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(image.mean[c], e[c], 0.02f * e[c])
                    << "channel " << c << " ribbons " << ribbons << " linear "
                    << (basis == CurveBasis::Linear);
        }
}

// White strands vanish in a white room, however often light goes from one to the next.
TEST(Fibres, WhiteHairInAWhiteRoomIsWhite) {
    for (bool ribbons : {false, true}) {
        MediaScene s;
        s.material("/m", hair(vec3(0)));
        std::vector<vec2> at;
        for (int i = 0; i < 60; ++i)
            at.push_back(vec2(0.11f * float(i % 20) - 1.045f, -0.13f * float(i / 20)));
        strands(s, at, 0.05f, CurveBasis::Bezier, ribbons);
        s.dome(1.0f);
        s.settings.maxDepth = 300;
        s.camera(vec3(0, 0, 5), 1.6f);
        const auto image = s.render(32, 32);
        EXPECT_TRUE(image.finite);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(image.mean[c], 1.0f, 0.02f) << c << " ribbons " << ribbons;
    }
}
