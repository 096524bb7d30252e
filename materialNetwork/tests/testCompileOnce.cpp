// SPDX-License-Identifier: Apache-2.0
// A material is expanded and compiled once, whatever is planned for it. Methods are bound to what
// was compiled.
#include "materialNetwork/compileCounts.h"
#include "materialNetwork/cpu/programCode.h"
#include "materialNetwork/tests/materialFixture.h"

namespace patina {

namespace {

struct Counts {
    long expansions, irs, programs;
};

Counts now() {
    const CompileCounts& c = compileCounts();
    return {c.expansions, c.irs, c.programs};
}

NetworkNode image(const char* path, const char* id) {
    return makeNode(path, id, {{"file", Value::makeFilename(std::string(path) + ".png")}});
}

/// A shading model with textures, whose roughness varies over them.
Network textured() {
    return makeNetwork(
        {image("color", "ND_image_color3"), image("rough", "ND_image_float"),
         makeNode("surface", "ND_standard_surface_surfaceshader", {},
                  {{"base_color", {"color", "out"}}, {"specular_roughness", {"rough", "out"}}})});
}

/// Its radius is a texture, which a diffuse surface has no use for.
Network skin() {
    return bsdfNetwork({image("color", "ND_image_color3"), image("radius", "ND_image_color3"),
                        makeNode("bsdf", "ND_subsurface_bsdf", {},
                                 {{"color", {"color", "out"}}, {"radius", {"radius", "out"}}})});
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
        FakeTextures textures;
        Diagnostics diagnostics;
        const Counts before = now();
        compileMaterial(textured(), textures, diagnostics, c.forced, c.tolerance);
        const Counts after = now();
        EXPECT_EQ(after.expansions - before.expansions, 1) << c.tolerance;
        EXPECT_EQ(after.irs - before.irs, 1) << c.tolerance;
        EXPECT_EQ(after.programs - before.programs, c.programs) << c.tolerance;
        EXPECT_EQ(textures.requests.size(), 2u) << c.tolerance;
    }
}

// As a texture that is missing: it is reported once, and not hidden by the planner.
TEST(CompileOnce, ProblemsAreReportedOnce) {
    Network network = textured();
    network.nodes.back().inputs["noSuchInput"] = Value::makeFloat(1.0f);
    const auto reported = [&](double tolerance) {
        FakeTextures textures;
        Diagnostics diagnostics;
        compileMaterial(network, textures, diagnostics, {}, tolerance);
        return warnings(diagnostics);
    };
    EXPECT_NE(reported(-1.0), "");
    EXPECT_EQ(reported(0.01), reported(-1.0));
}

TEST(CompileOnce, WhatABoundMethodDoesNotReadIsLeftOut) {
    const auto surface = [](const char* method, size_t opened) {
        FakeTextures textures;
        Diagnostics diagnostics;
        const auto program =
            compileMaterial(skin(), textures, diagnostics, {{"subsurface", method}});
        EXPECT_EQ(textures.requests.size(), opened) << method;
        Bsdf bsdf;
        program->evaluate(ShadingPoint(), bsdf);
        return std::make_pair(program->ir().surfaceCode.size(), bsdf.albedo());
    };
    const auto walk = surface("randomWalk", 2), diffuse = surface("diffuse", 1);
    EXPECT_LT(diffuse.first, walk.first);
    EXPECT_GT(diffuse.first, 0u) << "the colour is read";
    EXPECT_EQ(diffuse.second, walk.second);
}

} // namespace patina
