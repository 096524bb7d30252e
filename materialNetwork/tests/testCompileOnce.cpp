// SPDX-License-Identifier: Apache-2.0
// A material is expanded and compiled once, whatever is planned for it. Methods are bound to what
// was compiled.
#include "materialNetwork/compileCounts.h"
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

NetworkNode image(const char* path, const char* id) {
    return makeNode(path, id, {{"file", file(std::string(path) + ".png")}});
}

/// A shading model with textures, whose roughness varies over them.
Network textured() {
    return modelNetwork("ND_standard_surface_surfaceshader", {},
                        {{"base_color", "color.out"}, {"specular_roughness", "rough.out"}},
                        {image("color", "ND_image_color3"), image("rough", "ND_image_float")});
}

/// Its radius is a texture, which a diffuse surface has no use for.
Network skin() {
    return bsdfNetwork({image("color", "ND_image_color3"), image("radius", "ND_image_color3"),
                        makeNode("bsdf", "ND_subsurface_bsdf", {},
                                 {{"color", "color.out"}, {"radius", "radius.out"}})});
}

} // namespace

TEST(CompileOnce, WhateverIsPlanned) {
    const struct {
        double tolerance;
        MethodChoices forced;
        long programs; ///< what is planned is probed first
    } cases[] = {{-1.0, {}, 1},
                 {0.0, {}, 2},
                 {0.01, {}, 2},
                 {0.3, {}, 2},
                 {0.01, {{"layering", "positionFree"}, {"thinWalled", "solid"}}, 2}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.tolerance);
        const CompileCounts& counts = compileCounts();
        const long expansions = counts.expansions, irs = counts.irs, programs = counts.programs;
        const Compiled compiled(textured(), c.forced, c.tolerance);
        EXPECT_EQ(counts.expansions - expansions, 1);
        EXPECT_EQ(counts.irs - irs, 1);
        EXPECT_EQ(counts.programs - programs, c.programs);
        EXPECT_EQ(compiled.textures.requests.size(), 2u);
    }
}

// As a texture that is missing: it is reported once, and not hidden by the planner.
TEST(CompileOnce, ProblemsAreReportedOnce) {
    Network network = textured();
    network.nodes.back().inputs["noSuchInput"] = Value::makeFloat(1.0f);
    const auto reported = [&](double tolerance) {
        return warnings(Compiled(network, {}, tolerance));
    };
    EXPECT_NE(reported(-1.0), "");
    EXPECT_EQ(reported(0.01), reported(-1.0));
}

TEST(CompileOnce, WhatABoundMethodDoesNotReadIsLeftOut) {
    const Compiled walk(skin(), {{"subsurface", "randomWalk"}}),
        diffuse(skin(), {{"subsurface", "diffuse"}});
    EXPECT_EQ(walk.textures.requests.size(), 2u);
    EXPECT_EQ(diffuse.textures.requests.size(), 1u);
    EXPECT_LT(diffuse->ir().surfaceCode.size(), walk->ir().surfaceCode.size());
    EXPECT_GT(diffuse->ir().surfaceCode.size(), 0u) << "the colour is read";
    EXPECT_EQ(diffuse.albedo(), walk.albedo());
}
