// SPDX-License-Identifier: Apache-2.0
// Splats together with media and volumes. testenv/render/test_splats.py has them alone.

#include "hdDelegate/embree/media/tests/mediaScene.h"
#include "hdDelegate/image/fieldGrid.h"
#include "hdDelegate/scene/tests/prims.h"

using namespace patina;
using namespace patina::test;

namespace {

void splats(MediaScene& s, const std::vector<vec3>& positions, float scale, float opacity,
            const std::vector<vec3>& colors) {
    auto prim = makePrim<Splats>("/splats");
    SplatCloud cloud;
    cloud.degree = 0;
    cloud.positions = positions;
    for (const vec3& color : colors) {
        cloud.scales.push_back(vec3(scale));
        cloud.opacities.push_back(opacity);
        cloud.harmonics.push_back((color - 0.5f) / 0.28209479f);
    }
    setCloud(*prim, std::move(cloud), s.scene->diagnostics());
    s.scene->edit().set(std::move(prim));
}

/// A cube of -1..1, as a field of constant density or as a closed object.
void fog(MediaScene& s, bool field, const vec3& absorption, const vec3& scattering) {
    s.material("/m", volumeNodes(absorption, scattering), "volume");
    if (!field) return s.cube("/cube", vec3(0), vec3(2), "/m");
    constexpr int bricks = 8, n = bricks * FieldGrid::edge;
    mat4 place(2.0f / float(n));
    place[3] = vec4(vec3(-1.0f + 1.0f / float(n)), 1.0f);
    auto grid = std::make_shared<FieldGrid>(ivec3(0), ivec3(bricks), 1, place);
    for (int b = 0; b < bricks * bricks * bricks; ++b)
        grid->setBrick(ivec3(b / (bricks * bricks), b / bricks % bricks, b % bricks),
                       std::vector<float>(FieldGrid::voxels, 1.0f));
    auto prim = makePrim<Volume>("/volume");
    prim->material = "/m";
    prim->fields.push_back({"density", "", "", std::move(grid)});
    s.scene->edit().set(std::move(prim));
}

class SplatsInFog : public testing::TestWithParam<bool> {};

} // namespace

// Significance as in testMedia.cpp: five standard errors. 5e-3: a field falls off over half a voxel
// at its faces.
TEST_P(SplatsInFog, FogDimsWhatIsBehindAndInside) {
    MediaScene s;
    const vec3 absorption(0.25f, 0.5f, 1.0f), scattering(0.2f);
    fog(s, GetParam(), absorption, scattering);
    s.settings.maxScatterings = 0; // what scatters is lost
    const vec3 colors[] = {vec3(1, 0.5f, 0.25f), vec3(0.2f, 1, 0.5f), vec3(0.3f, 0.6f, 0.9f)};
    splats(s, {vec3(0, 0, 2), vec3(0), vec3(0, 0, -2)}, 0.1f, 0.5f,
           {colors[0], colors[1], colors[2]});
    s.camera(vec3(0, 0, 5), 1e-4f);
    expectMean(s.render(16, 64),
               0.5f * colors[0] + 0.25f * colors[1] * glm::exp(-absorption - scattering) +
                   0.125f * colors[2] * glm::exp(-2.0f * (absorption + scattering)),
               5e-3f);
}

/// Everything shines or scatters with radiance 1 and loses nothing: each ray sees 1, if the way to
/// a scattering event has what the kernels before it let through, and no more of them.
TEST_P(SplatsInFog, AWhiteWorldStaysWhite) {
    MediaScene s;
    fog(s, GetParam(), vec3(0), vec3(1.0f, 0.5f, 2.0f));
    splats(s, {vec3(0, 0, 1.5f), vec3(0.3f, 0, 0), vec3(-0.3f, 0.1f, 0.2f), vec3(0, 0, -1.5f)},
           0.4f, 0.7f, std::vector<vec3>(4, vec3(1)));
    s.whiteRoom(2.2f);
    expectMean(s.render(16, 256), vec3(1), 2e-3f);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SplatsInFog, testing::Values(false, true));
