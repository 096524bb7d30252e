// SPDX-License-Identifier: Apache-2.0
// Whole materials as the driver runs their generated text, against the program that the path tracer
// runs: values, densities, presence and emission at one shading point.

#include "hdDelegate/raster/tests/rasterFixture.h"
#include "materialNetwork/glsl/glslMaterial.h"
#include "materialNetwork/tests/materialFixture.h"

using namespace patina;

namespace {

struct NamedNetwork {
    std::string name;
    Network network;
};

NetworkNode stReader() {
    return makeNode("st", "UsdPrimvarReader_float2", {{"varname", text("st")}});
}
NetworkNode image(const std::string& name) {
    return makeNode(
        name, "UsdUVTexture",
        {{"file", Value::makeFilename(name)}, {"wrapS", text("repeat")}, {"wrapT", text("repeat")}},
        {{"st", {"st", "result"}}});
}

std::vector<NamedNetwork> networks() {
    const auto standard = [](Inputs inputs) {
        return makeNetwork({makeNode("surface", "standard_surface", std::move(inputs))});
    };
    return {
        {"displayColor", makeDisplayColorNetwork()},
        {"preview", previewNetwork({{"diffuseColor", color(0.8f, 0.3f, 0.1f)}})},
        {"previewMetal", previewNetwork({{"diffuseColor", color(1, 0.7f, 0.3f)},
                                         {"metallic", number(1.0f)},
                                         {"roughness", number(0.4f)},
                                         {"clearcoat", number(0.5f)}})},
        {"previewGlass", previewNetwork({{"opacity", number(0.25f)}, {"roughness", number(0.3f)}})},
        {"previewTextured",
         previewNetwork({{"opacityThreshold", number(0.0f)}, {"emissiveColor", grey(0.25f)}},
                        {{"diffuseColor", {"albedo", "rgb"}},
                         {"opacity", {"opacity", "r"}},
                         {"normal", {"normals", "rgb"}},
                         {"metallic", {"albedo", "g"}},
                         {"roughness", {"albedo", "r"}}},
                        {stReader(), image("albedo"), image("opacity"), image("normals")})},
        {"carPaint", standard({{"base_color", color(0.1f, 0.04f, 0.04f)},
                               {"specular_roughness", number(0.4f)},
                               {"specular_anisotropy", number(0.5f)},
                               {"coat", number(1.0f)},
                               {"coat_affect_color", number(0.5f)},
                               {"coat_roughness", number(0.2f)}})},
        {"velvet", standard({{"sheen", number(0.8f)}, {"diffuse_roughness", number(0.5f)}})},
        {"filmMetal", standard({{"metalness", number(1.0f)},
                                {"thin_film_thickness", number(400.0f)},
                                {"specular_roughness", number(0.3f)}})},
        {"thinGlass", standard({{"transmission", number(0.6f)},
                                {"thin_walled", Value::makeBool(true)},
                                {"specular_roughness", number(0.2f)},
                                {"emission", number(1.0f)}})},
        {"openPbr", makeNetwork({makeNode("surface", "open_pbr_surface",
                                          {{"base_color", color(0.9f, 0.6f, 0.3f)},
                                           {"base_metalness", number(0.5f)},
                                           {"specular_roughness", number(0.4f)},
                                           {"coat_weight", number(1.0f)},
                                           {"coat_color", color(0.8f, 0.9f, 1.0f)}})})},
        {"gltf", makeNetwork({makeNode("surface", "gltf_pbr",
                                       {{"base_color", color(0.5f, 0.25f, 0.125f)},
                                        {"metallic", number(0.0f)},
                                        {"alpha", number(0.5f)},
                                        {"alpha_mode", text("BLEND")},
                                        {"clearcoat", number(0.25f)},
                                        {"emissive", color(1, 0.5f, 0)}})})},
        {"layerOverMix",
         bsdfNetwork(
             {makeNode("diffuse", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.5f)}}),
              makeNode("metal", "ND_conductor_bsdf"),
              makeNode("coat", "ND_dielectric_bsdf", {{"weight", number(0.5f)}}),
              makeNode("amount", "ND_geompropvalue_float",
                       {{"geomprop", text("wear")}, {"default", number(0.25f)}}),
              makeNode("mix", "ND_mix_bsdf", {},
                       {{"fg", {"metal", ""}}, {"bg", {"diffuse", ""}}, {"mix", {"amount", ""}}}),
              makeNode("bsdf", "ND_layer_bsdf", {},
                       {{"top", {"coat", ""}}, {"base", {"mix", ""}}})})},
        {"beckmannMetal", bsdfNetwork({makeNode("bsdf", "ND_conductor_bsdf",
                                                {{"roughness", Value::makeVec2(0.2f, 0.6f)},
                                                 {"distribution", text("beckmann")}})})},
        {"beckmannGlass", bsdfNetwork({makeNode("bsdf", "ND_dielectric_bsdf",
                                                {{"roughness", pair(0.4f)},
                                                 {"scatter_mode", text("RT")},
                                                 {"distribution", text("beckmann")}})})},
        {"mixedShaders",
         makeNetwork(
             {makeNode("paint", "standard_surface", {{"opacity", grey(0.75f)}}),
              makeNode("lamp", "ND_surface_unlit", {{"emission_color", color(0, 0.5f, 1)}}),
              makeNode("both", "ND_mix_surfaceshader", {{"mix", number(0.25f)}},
                       {{"fg", {"lamp", ""}}, {"bg", {"paint", ""}}}),
              makeNode("behind", "ND_surface_unlit", {{"emission", number(3.0f)}}),
              makeNode("surface", "ND_surfacematerial", {},
                       {{"surfaceshader", {"both", ""}}, {"backsurfaceshader", {"behind", ""}}})})},
        {"arithmetic",
         bsdfNetwork(
             {makeNode("uv", "ND_texcoord_vector2"),
              makeNode("place", "ND_place2d_vector2",
                       {{"rotate", number(30.0f)}, {"scale", pair(0.7f)}},
                       {{"texcoord", {"uv", ""}}}),
              makeNode("x", "ND_extract_vector2", {{"index", Value::makeInt(0)}},
                       {{"in", {"place", ""}}}),
              makeNode("wave", "ND_sin_float", {}, {{"in", {"x", ""}}}),
              makeNode("power", "ND_power_float", {{"in2", number(2.2f)}}, {{"in1", {"wave", ""}}}),
              makeNode("step", "ND_smoothstep_float", {{"high", number(0.9f)}},
                       {{"in", {"power", ""}}}),
              makeNode("blend", "ND_mix_color3",
                       {{"fg", color(1, 0.2f, 0.1f)}, {"bg", color(0.1f, 0.4f, 1)}},
                       {{"mix", {"step", ""}}}),
              makeNode("hsv", "ND_hsvadjust_color3", {{"amount", Value::makeVec3(0.1f, 0.8f, 1)}},
                       {{"in", {"blend", ""}}}),
              makeNode("bsdf", "ND_burley_diffuse_bsdf", {{"roughness", number(0.4f)}},
                       {{"color", {"hsv", ""}}})})},
    };
}

constexpr int directions = 24;

ShadingPoint pointOf(const FakePrimvars& primvars) {
    ShadingPoint p;
    p.position = p.objectPosition = {0.1f, 0.2f, 0.3f};
    p.normal = p.geometricNormal = {0, 0, 1};
    p.viewDirection = direction(35.0f, 20.0f);
    p.primvars = &primvars;
    return p;
}

std::string shaderOf(const MaterialProgram& program, const GlslMaterial& glsl) {
    std::string primvars = "vec4 primvar(int slot, vec4 fallback) {\n";
    for (size_t i = 0; i < program.primvars().size(); ++i)
        if (program.primvars()[i].name == "st")
            primvars +=
                "    if (slot == " + std::to_string(i) + ") return vec4(0.4, 0.6, 0.0, 0.0);\n";
    primvars += "    return fallback;\n}\n";
    return glsl.definitions + "#include \"shaders/raster/material.glsl\"\n" + glsl.text + primvars +
           R"(
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Points { vec4 points[]; };
layout(std430, binding = 6) writeonly buffer Answers { vec4 answers[]; };
void main() {
    point.position = point.objectPosition = vec3(0.1, 0.2, 0.3);
    point.geometricNormal = point.normal = vec3(0.0, 0.0, 1.0);
    point.tangent = vec3(1.0, 0.0, 0.0);
    point.bitangent = vec3(0.0, 1.0, 0.0);
    point.view = points[0].xyz;
    point.objectToWorldNormal = mat3(1.0);
    point.uvFootprint = 0.0;
    int i = int(gl_GlobalInvocationID.x);
    vec3 passes;
    float presence = materialPresence(passes);
    materialSetup();
    MaterialEval e = materialEval(points[i + 1].xyz);
    answers[4 * i] = vec4(e.diffuse, e.pdf);
    answers[4 * i + 1] = vec4(e.specular, presence);
    answers[4 * i + 2] = vec4(materialEmission(point.view), 0.0);
    answers[4 * i + 3] = vec4(passes, 0.0);
}
)";
}

} // namespace

class MaterialAgreement : public ::testing::TestWithParam<size_t> {};

TEST_P(MaterialAgreement, OfTextWithProgram) {
    PATINA_NEED_CONTEXT();
    const NamedNetwork named = networks()[GetParam()];
    Compiled c(named.network);
    EXPECT_EQ(warnings(c.diagnostics), "");
    const GlslMaterial glsl = makeGlslMaterial(c.program->ir());
    EXPECT_TRUE(glsl.leftOut.empty());
    const auto program = computeProgram(named.name, shaderOf(*c.program, glsl));
    ASSERT_TRUE(program);

    const FakePrimvars primvars(*c.program, {{"st", {0.4f, 0.6f, 0, 0}}});
    const ShadingPoint point = pointOf(primvars);
    std::vector<glm::vec4> points = {glm::vec4(point.viewDirection, 0.0f)};
    Random random(7);
    for (int i = 0; i < directions; ++i)
        points.emplace_back(random.direction(), 0.0f);
    // The values of FakeTextures, as texels: linear in uv, so that filtering keeps it.
    const int side = 64;
    std::vector<glm::vec4> texels;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            texels.emplace_back((float(x) + 0.5f) / side, (float(y) + 0.5f) / side, 0.5f, 1.0f);
    const GlTexture texture(GL_TEXTURE_2D, GL_RGBA32F, side, side);
    gl.TextureSubImage2D(texture.id(), 0, 0, 0, side, side, GL_RGBA, GL_FLOAT, texels.data());
    texture.parameter(GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    for (size_t i = 0; i < glsl.textures.size(); ++i)
        texture.bind(GLuint(i));
    const std::vector<float> table(patinaAlbedoTable, patinaAlbedoTable + sh::ALBEDO_TABLE_SIZE);
    const GlBuffer parameters(glsl.parameters), pointBuffer(points), tableBuffer(table),
        answerBuffer(size_t(directions) * 4 * sizeof(glm::vec4), nullptr);
    parameters.bindUniform(1);
    pointBuffer.bindStorage(0);
    answerBuffer.bindStorage(6);
    tableBuffer.bindStorage(7);
    const auto answers =
        computed<glm::vec4>(*program, directions, answerBuffer, size_t(directions) * 4);

    glm::vec3 passes;
    const float presence = c.program->opacity(point, &passes);
    const glm::vec3 emission = c.program->emission(point, point.viewDirection);
    Bsdf bsdf;
    c.program->evaluate(point, bsdf);
    float brightest = 0.0f;
    for (int i = 0; i < directions; ++i) {
        const BsdfEval e = bsdf.eval(glm::vec3(points[size_t(i) + 1]));
        const glm::vec4* a = &answers[4 * size_t(i)];
        SCOPED_TRACE("direction " + std::to_string(i));
        // The program reads albedos of constant interfaces off a curve that is within 2e-3.
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(a[0][k], e.diffuse[k], 3e-3f * e.diffuse[k] + 1e-5f);
            EXPECT_NEAR(a[1][k], e.specular[k], 3e-3f * e.specular[k] + 1e-5f);
            EXPECT_NEAR(a[2][k], emission[k], 1e-5f * emission[k]);
            EXPECT_NEAR(a[3][k], passes[k], 1e-4f);
        }
        EXPECT_NEAR(a[0].w, e.pdf, 1e-2f * e.pdf + 1e-5f);
        EXPECT_NEAR(a[1].w, presence, 1e-4f);
        brightest = std::max(brightest, e.diffuse.x + e.specular.x);
    }
    EXPECT_GT(brightest, 0.0f);
}

INSTANTIATE_TEST_SUITE_P(EveryKind, MaterialAgreement,
                         ::testing::Range(size_t(0), networks().size()),
                         [](const auto& info) { return networks()[info.param].name; });

// A parameter edit must not make another shader, and nothing that a scene says may be in one.
TEST(GlslMaterial, TextHasNeitherNumbersNorNamesOfTheScene) {
    const auto textOf = [](float roughness, const std::string& file) {
        NetworkNode node = image("albedo");
        node.inputs["file"] = Value::makeFilename(file);
        Compiled c(previewNetwork({{"roughness", number(roughness)}, {"ior", number(1.7f)}},
                                  {{"diffuseColor", {"albedo", "rgb"}}}, {stReader(), node}));
        return makeGlslMaterial(c.program->ir()).text;
    };
    const std::string a = textOf(0.3f, "a.png"), b = textOf(0.7f, "}; discard; //");
    EXPECT_EQ(a, b);
    EXPECT_EQ(a.find("discard"), std::string::npos);
    EXPECT_EQ(a.find("albedo.png"), std::string::npos);
    EXPECT_NE(a.find("sampler0"), std::string::npos);
}
