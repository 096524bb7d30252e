// SPDX-License-Identifier: Apache-2.0
// Generated texts compared with reviewed files, and read by the reference compiler.
#include "materialNetwork/glsl/glslMaterial.h"
#include "materialNetwork/tests/materialFixture.h"
#include "materialNetwork/tests/reviewed.h"
#include "shaders/shaderText.h"

using namespace patina;

namespace {

Network coatedPlastic() {
    return bsdfNetwork({diffuseNode("diffuse", color(0.5f, 0.25f, 0.1f)),
                        makeNode("coat", "ND_dielectric_bsdf", {{"roughness", pair(0.2f)}}),
                        layerNode("bsdf", "coat", "diffuse")});
}

/// Strings that would end a statement, a comment or the text, had they a way into it.
const char* const hostile = "x\"; } discard; /* \\\n#error\n*/ // ../../etc";

Network texturedBumps(const std::string& word) {
    return bsdfNetwork(
        {makeNode("uv", "ND_geompropvalue_vector2", {{"geomprop", word}}),
         makeNode("albedo", "ND_image_color3", {{"file", file(word)}}, {{"texcoord", "uv"}}),
         makeNode("height", "ND_fractal2d_float", {}, {{"texcoord", "uv"}}),
         makeNode("slope", "ND_heighttonormal_vector3", {}, {{"in", "height"}}),
         makeNode("bump", "ND_normalmap_float", {}, {{"in", "slope"}}),
         makeNode("bsdf", "ND_burley_diffuse_bsdf", {},
                  {{"color", "albedo"}, {"normal", "bump"}})});
}

Network flakesUnderGlass() {
    return bsdfNetwork(
        {makeNode("flake", "ND_flake3d", {{"size", 0.05f}}),
         makeNode("metal", "ND_conductor_bsdf", {}, {{"normal", "flake.flakenormal"}}),
         makeNode("glass", "ND_dielectric_bsdf",
                  {{"scatter_mode", "RT"}, {"roughness", pair(0.1f)}}),
         makeNode("bsdf", "ND_mix_bsdf", {},
                  {{"fg", "glass"}, {"bg", "metal"}, {"mix", "flake.presence"}})});
}

std::string whole(const GlslMaterial& glsl) {
    const std::string around = "vec4 primvar(int slot, vec4 fallback) { return fallback; }\n"
                               "layout(location = 0) out vec4 outColor;\n"
                               "void main() {\n    materialSetup();\n    vec3 passes;\n"
                               "    outColor = vec4(materialEval(point.view).diffuse, "
                               "materialPresence(passes));\n}\n";
    std::string error;
    const std::string text =
        flattenShader("material",
                      glsl.definitions + "#include \"shaders/raster/material.glsl\"\n" + glsl.text +
                          around,
                      error)
            .text;
    EXPECT_EQ(error, "");
    return "#version 450 core\n" + text;
}

} // namespace

class GlslText : public ::testing::TestWithParam<const char*> {
protected:
    GlslMaterial made() const {
        const std::string name = GetParam();
        const Network network = name == "coatedPlastic"   ? coatedPlastic()
                                : name == "texturedBumps" ? texturedBumps("wood")
                                                          : flakesUnderGlass();
        const CleanCompiled c(network);
        const GlslMaterial glsl = makeGlslMaterial(c->ir());
        EXPECT_TRUE(glsl.leftOut.empty());
        return glsl;
    }
};

TEST_P(GlslText, IsAsReviewed) {
    expectReviewed(std::string(PATINA_EXPECTED_DIR) + "/" + GetParam() + ".glsl", made().text);
}

TEST_P(GlslText, IsTakenByTheReferenceCompiler) {
    if (std::system("command -v glslangValidator >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "glslangValidator is not installed";
    const std::string path = ::testing::TempDir() + "patina_" + GetParam() + ".frag";
    std::ofstream(path) << whole(made());
    EXPECT_EQ(std::system(("glslangValidator " + path).c_str()), 0);
    std::remove(path.c_str());
}

INSTANTIATE_TEST_SUITE_P(Materials, GlslText,
                         ::testing::Values("coatedPlastic", "texturedBumps", "flakesUnderGlass"));

TEST(GlslDefinitions, SayWhatAllLobesHaveInCommon) {
    const std::string exact = "#define PATINA_ALBEDO_METHOD(method) 0\n";
    const std::string none = exact + "#define PATINA_FILM(present) false\n";
    const auto definitions = [](float thickness, const MethodChoices& methods) {
        const Compiled c(lobeNetwork("ND_conductor_bsdf", {{"thinfilm_thickness", thickness}}),
                         methods);
        return makeGlslMaterial(c->ir()).definitions;
    };
    EXPECT_EQ(definitions(0.0f, {}), "#define PATINA_COMPENSATE(compensate) 1\n" + none);
    EXPECT_EQ(definitions(0.0f, {{"energyCompensation", "kullaConty"}}),
              "#define PATINA_COMPENSATE(compensate) 2\n" + none);
    EXPECT_EQ(definitions(400.0f, {}), "#define PATINA_COMPENSATE(compensate) 1\n" + exact +
                                           "#define PATINA_FILM_METHOD(method) 0\n");
    const std::string karis = definitions(0.0f, {{"directionalAlbedo", "karis"}});
    EXPECT_TRUE(has(karis, "PATINA_ALBEDO_METHOD(method) 2\n"));
}

TEST(GlslTextStrings, NeverReachTheText) {
    const auto textOf = [](const std::string& word) {
        return makeGlslMaterial(Compiled(texturedBumps(word))->ir()).text;
    };
    EXPECT_EQ(textOf("wood"), textOf(hostile));
}

// A material of many textures has no more samplers than OpenGL promises.
TEST(GlslTextTextures, ShareUnitsWhereThereAreTooMany) {
    std::vector<NetworkNode> nodes;
    const int count = 20;
    for (int i = 0; i < count; ++i) {
        const std::string image = numbered("image", i),
                          before = numbered(i > 1 ? "sum" : "image", i - 1);
        nodes.push_back(makeNode(image, "ND_image_color3", {{"file", file(image + ".png")}}));
        if (i > 0) nodes.push_back(binaryNode(numbered("sum", i), "ND_add_color3", before, image));
    }
    nodes.push_back(
        makeNode("bsdf", "ND_burley_diffuse_bsdf", {}, {{"color", numbered("sum", count - 1)}}));
    const Compiled c(bsdfNetwork(nodes));
    const GlslMaterial glsl = makeGlslMaterial(c->ir());
    ASSERT_EQ(glsl.textures.size(), size_t(count));
    for (int i = 0; i < count; ++i) {
        EXPECT_EQ(glsl.textures[size_t(i)].unit, std::min(i, glslTextureUnits - 1));
        EXPECT_EQ(glsl.textures[size_t(i)].shared, i >= glslTextureUnits - 1);
    }
    EXPECT_EQ(glsl.textures.back().firstLayer, count - glslTextureUnits);
    ASSERT_EQ(glsl.leftOut.size(), 1u);
    EXPECT_EQ(glsl.leftOut[0].id, MessageId::texturesShareSize);
    EXPECT_FALSE(has(glsl.text, "sampler16"));
}
