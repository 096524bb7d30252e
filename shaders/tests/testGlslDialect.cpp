// SPDX-License-Identifier: Apache-2.0
// Lobes, patterns and lights as GLSL: every file of the dialect compiles as a compute shader (with
// storage buffer) and as an OpenGL ES 3.0 fragment shader (with the host's own table look-up).

#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace {

const std::string sourceRoot = PATINA_SOURCE_DIR;
const std::string validator = PATINA_GLSLANG_VALIDATOR;

// Text of a file with its #include lines replaced by what they name, as the rasterizer reads it.
std::string flatten(const std::string& path) {
    std::ifstream in(sourceRoot + "/" + path);
    if (!in) in.open(std::string(PATINA_GENERATED_DIR) + "/" + path);
    EXPECT_TRUE(in.good()) << path;
    std::string text, line;
    while (std::getline(in, line)) {
        const std::string directive = "#include \"";
        if (line.compare(0, directive.size(), directive) == 0) {
            const std::size_t end = line.find('"', directive.size());
            text += flatten(line.substr(directive.size(), end - directive.size()));
        } else
            text += line + "\n";
    }
    return text;
}

// Compiles through the validator; returns its output, empty when all is well.
std::string compile(const std::string& source, const std::string& stage) {
    const std::string file = ::testing::TempDir() + "patinaDialect." + stage;
    std::ofstream(file) << source;
    std::FILE* pipe = popen((validator + " -S " + stage + " " + file + " 2>&1").c_str(), "r");
    if (!pipe) return "cannot run " + validator;
    std::string output;
    char buffer[512];
    while (std::fgets(buffer, sizeof buffer, pipe))
        output += buffer;
    const int status = pclose(pipe);
    std::remove(file.c_str());
    return status == 0 ? std::string() : output + "\nstatus " + std::to_string(status);
}

// Calls of every lobe, so that nothing is left unlinked.
std::string lobeCalls() {
    // Of prefixSetup() the arguments, of what is made otherwise all that stands for it.
    const char* const lobes[][3] = {
        {"orenNayar", "o", "vec3(0.8), 0.3, true"},
        {"burley", "b", "vec3(0.8), 0.3"},
        {"translucent", "t", "vec3(0.8)"},
        {"conductor", "c", "vec3(0.2), vec3(3.0), vec2(0.2), false, 1"},
        {"dielectric", "d", "vec3(1.0), 1.5, vec2(0.2), false, SCATTER_RT, false, 1"},
        {"schlick", "s",
         "vec3(0.04), vec3(1.0), vec3(1.0), 5.0, vec2(0.2), false, SCATTER_RT, false, 1"},
        {"sheen", "k", "vec3(0.8), 0.3, SHEEN_CONTY_KULLA"},
        {"sheen", "z", "vec3(0.8), 0.3, SHEEN_ZELTNER"},
        {"phaseHenyeyGreenstein", "p", "0.5"},
        {"phong", "q", "vec3(0.8), 20.0"},
        {"blinnPhong", "n", "vec3(0.8), 20.0"},
        {"ward", "w", "vec3(0.8), vec2(0.2), WARD_BOUNDED"},
        {"cookTorrance", "x", "vec3(0.8), vec3(1.5), vec3(0.0), 0.2, COOK_TORRANCE_SCHLICK"},
        {"chiangHair", "h",
         "vec3(1.0), vec3(1.0), vec3(1.0), 1.55, vec2(0.1), vec2(0.1), vec2(0.2), 0.5, vec3(0.3)"},
        {"subsurface", "i", "vec3(0.8), vec3(1.0), 0.0"},
        {"conductor", "cf", "= conductorFilm(c, 300.0, 1.5)"},
        {"schlick", "sf", "= schlickFilm(s, 300.0, 1.5)"},
        {"schlick", "df",
         "= filmDielectricSetup(vec3(1.0), 1.5, vec2(0.2), 300.0, 1.3, false, SCATTER_RT, false, "
         "1)"},
        {"conductor", "cb", "= c; cb.ndf = NDF_BECKMANN"},
        {"dielectric", "db", "= d; db.ndf = NDF_BECKMANN"}};
    std::string text = "vec3 everyLobe(vec3 wo, vec3 wi, vec3 u) {\n    vec3 sum = vec3(0.0);\n";
    for (const auto& [prefix, name, made] : lobes) {
        const std::string f = prefix, l = name;
        text += char(std::toupper(f[0])) + f.substr(1) + "Lobe " + l +
                (made[0] == '=' ? made : " = " + f + "Setup(" + made + ")") + ";\nsum += " + f +
                "Eval(" + l + ", wo, wi).value + " + f + "Sample(" + l + ", wo, u).weight + " + f +
                "Albedo(" + l + ", wo);\n";
    }
    return text + R"(
    vec3 albedo = vec3(0.0);
    sum += lobeFix(o, wo, albedo) + lobeFix(b, wo, albedo) + lobeFix(t, wo, albedo) +
           lobeFix(c, wo, albedo) + lobeFix(d, wo, albedo) + lobeFix(s, wo, albedo) +
           lobeFix(k, wo, albedo) + lobeFix(i, wo, albedo) + albedo;
    sum += lobePasses(d, wo.z) + lobePasses(s, wo.z) + lobeRoughness(q) + lobeRoughness(n) +
           lobeRoughness(w) + lobeRoughness(x) + lobeRoughness(c) + lobeRoughness(d) +
           lobeRoughness(s);
    if (lobeIsDelta(c) || lobeIsDelta(d) || lobeIsDelta(s)) sum = vec3(0.0);
    sum += edfSchlick(wo, wi, 5.0, u.x) * edfConical(60.0, 90.0, wo.z);
    return sum;
}
)";
}

// How lobes become a material.
const char* const closureCalls = R"(
vec3 everyClosure(vec3 wo, vec3 wi, vec3 u) {
    Frame f = shadingFrame(wo, wi, wi, u, vec3(0.0), vec3(0.0), true, true);
    DielectricLobe d = dielectricSetup(vec3(1.0), 1.5, vec2(0.2), false, SCATTER_RT, false, 1);
    SchlickLobe s = schlickSetup(vec3(0.04), vec3(1.0), vec3(1.0), 5.0, vec2(0.2), false,
                                 SCATTER_RT, false, 1);
    vec3 albedo = vec3(0.0);
    Slab slab = dielectricSlab(d, f.wo, albedo, true);
    Slab colored = schlickSlab(s, f.wo, albedo, false);
    vec3 passes;
    float presence = presenceOf(0.5, slab.transmittance, passes) * slabScale(passes);
    LayerLight base = layerOfLobe(albedo, layerKinds(0.2, wo.z, 0.0));
    LayerLight top = layerThrough(0.5, u, layerInside(u, 0.7, wo.z), 0.2, wo.z, base);
    top = layerMix(layerTinted(layerRest(top, 0.5), u), layerBeside(top, layerPast(0.5, u)), 0.5);
    vec3 sum = layerWeight(layerSum(layerCovered(top, u), layerShare(base, 0.5)), u) +
               passCovered(passBeside(passLobe(u, 0.5), shareAverage(u)), shareLargest(u));
    sum += layerInsideDielectric(0.1, 1.5, 0.7, wo.z) * closureTinted(closureRest(u, 0.5), u);
    MaterialEval e = materialEvalNone();
    bool reflects = isReflected(wi, f.normal, true);
    addLobe(e, lobeAgrees(f.wo.z, wi.z, reflects) && hasWeight(u), true, u, 1.0,
            dielectricEval(d, f.wo, toLocal(f, wi)));
    Selection drawn = selectionNone();
    selectLobe(drawn, 1, selectionShare(u, albedo, false), u.x);
    sum += e.diffuse + drawnValue(u, e.specular, e.pdf) + drawnAlone(u, u, float(drawn.lobe));
    sum += emissionConical(u, 60.0, 90.0, wo, wi) + emissionTinted(emissionScaled(u, 2.0), u) +
           emissionSchlick(u, u, u, 5.0, wo, wi) + vec3(azimuthOf(wo, wi, u), presence);
    Medium m = mediumNone();
    addAnisotropic(m, closureMix(u, wo, 0.5), u, closureProduct(u, u), 0.5);
    addAbsorption(m, closureSum(u, u), closureScaled(u, 0.5));
    PhaseMixture phase = phaseMixture(m, u);
    return sum + colored.reflected + phaseMixtureEval(phase, wo, wi).value +
           phaseMixtureSample(phase, wo, u, u.x).wi + toWorld(f, wi);
}
)";

// The pattern functions, every file of them.
const char* const patternCalls = R"(
vec3 everyPattern(vec3 p) {
    HexSpread spread;
    spread.rotation = 1.0;
    spread.rotationRange = vec2(0.0, 360.0);
    spread.scale = 1.0;
    spread.scaleRange = vec2(0.5, 2.0);
    spread.offset = 1.0;
    spread.offsetRange = vec2(0.0, 1.0);
    HexTiles tiles = hexTiles(p.xy, spread);
    FlakeHit flake = patternFlake(0.1, 0.1, 0.5, p, p, p, p);
    vec3 sum = patternBlackbody(p.x) + patternHsvAdjust(p, p) + patternSaturate(p, 0.5, p) +
               hexShares(tiles, p, 0.3) + normalGradient(p, p) + flake.normal +
               worleyNoise2(p.xy, 1.0, 0) + worleyNoise3(p, 1.0, 1) + patternRotate3d(p, 1.0, p);
    float x = noiseFractal2(p.xy, 3, 2.0, 0.5, 8) + noiseFractal3(p, 3, 2.0, 0.5, 0) +
              noiseCell2(p.xy) + worleyScalar2(p.xy, 1.0, 0) + worleyScalar3(p, 1.0, 0) +
              patternShape(2, p.xy, 0.3) + patternChecker(p.xy) + patternGrid(p.xy, 0.1, true) +
              patternCrosshatch(p.xy, 0.1, false) + patternTiledShape(0, p.xy, 0.3, true, 0.5) +
              patternRampPosition(p.xy, 1) + patternRampBlend(p.x, 0.0, 1.0, 1) +
              patternRamp4(1.0, 2.0, 3.0, 4.0, p.xy) + patternRange(p.x, 0.0, 1.0, 2.0, 0.0, 1.0);
    return sum + vec3(x);
}
)";

// The functions of pattern nodes, every file of them.
std::string nodeFunctions() {
    std::set<std::string> files;
    const std::string folder = "shaders/patterns/nodes/";
    for (const auto& entry : std::filesystem::directory_iterator(sourceRoot + "/" + folder))
        files.insert(folder + entry.path().filename().string());
    EXPECT_GT(files.size(), 15u);
    std::string text = flatten("shaders/compat/nodes.glsl") +
                       "vec4 texel(int map, vec2 uv, float footprint) { return vec4(0.0); }\n";
    for (const std::string& file : files)
        text += flatten(file);
    return text;
}

// The functions of lights, every file of them.
const char* const lightCalls = R"(
vec3 everyLight(vec3 p, vec3 w, vec2 u) {
    ShapeFrame f = ShapeFrame(p, mat3(1.0), mat3(1.0), 1.0);
    Shaping s = Shaping(w, p, p, p, 1.0, true, 0.1, 0.2);
    LightBasis b = lightBasis(w);
    ShapePoint x;
    vec3 q, d;
    float t, pdf = 0.0;
    TableCell c = directionCell(9, 5, u.x, iesAzimuth(p, w, w));
    vec3 sum = tableMix(c, p, w, p, w) + tableMix(rectTexels(p, 8, 4), p, w, p, w) +
               shapingBeam(s, shapingCosine(s, w)) + rectPlace(u) + diskPlace(u) +
               cylinderPlace(u) + sphereLightPlace(p) + distantSample(b, 0.1, u) +
               domeDirection(domeTexel(w));
    if (rectHit(p, w, t, q) || diskHit(p, w, t, q) || sphereHit(p, w, t, q) ||
        cylinderHit(p, w, t, q) || sphereLightHit(p, w, 1.0, t, pdf) || distantHit(p, 0.1, w))
        sum += q * t * distantPdf(0.1);
    for (int kind = 0; kind < SHAPES; ++kind)
        if (shapeHit(kind, p, w, t, q))
            sum += (shapePlace(kind, u) + shapeNormalAt(kind, f, q) + shapeExtent(kind, f)) *
                   shapePlaceDensity(kind, f, q);
    if (sphereSample(f, p, u, x)) sum += x.position * spherePdf(f, p, x.position);
    if (cylinderSample(f, p, u, x)) sum += x.normal * cylinderPdf(f, p, x.position, x.normal);
    if (lineSample(p, w, p, u.x, d, pdf)) sum += d * pdf * lineAcross(w, d);
    return sum;
}
)";

/// All of them, between what a stage begins with and what it does with EVERYTHING, their sum.
std::string shader(const std::string& begin, const std::string& end) {
    return begin + flatten("shaders/compat/glsl.glsl") + flatten("shaders/lobes.glsl") +
           lobeCalls() + flatten("shaders/closure.glsl") + closureCalls +
           flatten("shaders/patterns.glsl") + patternCalls + nodeFunctions() +
           flatten("shaders/lights.glsl") + lightCalls +
           "#define EVERYTHING vec4(everyLobe(vec3(0, 0, 1), vec3(0, 0, 1), vec3(0.5)) + "
           "everyClosure(vec3(0, 0, 1), vec3(0, 0, 1), vec3(0.5)) + everyPattern(vec3(0.5)) + "
           "everyLight(vec3(0.5), vec3(0, 0, 1), vec2(0.5)), 1)\n" +
           end;
}

class GlslDialect : public ::testing::Test {
protected:
    void SetUp() override {
        if (validator.empty()) GTEST_SKIP() << "glslangValidator not found (package glslang-tools)";
    }
};

} // namespace

TEST_F(GlslDialect, CompilesAsComputeShader) {
    EXPECT_EQ(compile(shader("#version 450\n",
                             "layout(local_size_x = 64) in;\n"
                             "layout(std430, binding = 0) buffer Out { vec4 result[]; };\n"
                             "void main() { result[gl_GlobalInvocationID.x] = EVERYTHING; }\n"),
                      "comp"),
              "");
}

TEST_F(GlslDialect, CompilesAsEsFragmentShader) {
    EXPECT_EQ(compile(shader("#version 300 es\nprecision highp float;\nprecision highp int;\n"
                             "uniform highp sampler2D table;\n"
                             "#define PATINA_ALBEDO_TABLE_FETCH\n"
                             "float albedoTableFetch(int i) {"
                             " return texelFetch(table, ivec2(i & 1023, i >> 10), 0).x; }\n",
                             "out vec4 color;\nvoid main() { color = EVERYTHING; }\n"),
                      "frag"),
              "");
}

TEST_F(GlslDialect, RejectsWhatIsNotGlsl) {
    EXPECT_NE(compile("#version 450\nvoid main() { float x = nothing(); }\n", "vert"), "");
}
