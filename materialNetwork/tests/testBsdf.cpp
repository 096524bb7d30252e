// SPDX-License-Identifier: Apache-2.0
// The BSDF of whole materials: energy, sampling, layers, sides.
#include "materialNetwork/tests/materialFixture.h"
#include "shaders/tests/pearson.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

ShadingPoint seenFrom(const glm::vec3& wo) {
    ShadingPoint point;
    point.viewDirection = wo;
    return point;
}

/// Mean of the sample weights: the directional albedo by Monte Carlo.
glm::vec3 sampledAlbedo(const Bsdf& bsdf, int n, uint32_t seed, double* deviation = nullptr) {
    Random random(seed);
    glm::dvec3 sum(0.0), squares(0.0);
    for (int i = 0; i < n; ++i) {
        const BsdfSample s = bsdf.sample(random.next3(), random.next());
        const glm::dvec3 w(s.weight);
        sum += w;
        squares += w * w;
    }
    const glm::dvec3 mean = sum / double(n);
    if (deviation) *deviation = std::sqrt(std::max(0.0, squares.y / n - mean.y * mean.y) / n);
    return glm::vec3(mean);
}

struct Variant {
    const char* name;
    Inputs inputs;
};

const std::vector<Variant> variants = {
    {"white plastic", {{"diffuseColor", grey(1.0f)}}},
    {"smooth plastic", {{"diffuseColor", grey(1.0f)}, {"roughness", number(0.0f)}}},
    {"rough plastic", {{"diffuseColor", grey(1.0f)}, {"roughness", number(1.0f)}}},
    {"white metal", {{"diffuseColor", grey(1.0f)}, {"metallic", number(1.0f)}}},
    {"half metal", {{"diffuseColor", color(1, 0.5f, 0.2f)}, {"metallic", number(0.5f)}}},
    {"coated", {{"diffuseColor", grey(1.0f)}, {"clearcoat", number(1.0f)}}},
    {"rough coat over metal",
     {{"diffuseColor", grey(1.0f)},
      {"metallic", number(1.0f)},
      {"clearcoat", number(1.0f)},
      {"clearcoatRoughness", number(0.7f)}}},
    {"specular workflow",
     {{"diffuseColor", grey(1.0f)},
      {"useSpecularWorkflow", Value::makeInt(1)},
      {"specularColor", color(0.9f, 0.4f, 0.1f)}}},
    {"glass", {{"opacity", number(0.0f)}, {"roughness", number(0.0f)}}},
    {"half glass", {{"diffuseColor", grey(1.0f)}, {"opacity", number(0.5f)}}},
};

} // namespace

// Budget: the tables are within 2e-3 of the albedo that sampling finds, and no variant gains.
TEST(Bsdf, PreviewSurfaceNeverGainsEnergy) {
    for (const Variant& v : variants) {
        Compiled c(previewNetwork(v.inputs));
        for (const float theta : {0.0f, 30.0f, 60.0f, 80.0f, 89.0f}) {
            Bsdf bsdf;
            c.program->evaluate(seenFrom(direction(theta, 20.0f)), bsdf);
            const glm::vec3 a = bsdf.albedo();
            EXPECT_LE(std::max({a.x, a.y, a.z}), 1.002f) << v.name << " at " << theta;
            EXPECT_GE(std::min({a.x, a.y, a.z}), 0.0f) << v.name << " at " << theta;
            double deviation = 0.0;
            const glm::vec3 sampled = sampledAlbedo(bsdf, 20000, 7, &deviation);
            // Four standard errors: p = 6e-5 per comparison, 50 comparisons, one fixed seed.
            EXPECT_NEAR(sampled.y, a.y, 4.0 * deviation + 4e-3) << v.name << " at " << theta;
        }
    }
}

TEST(Bsdf, WhiteLambertIsExact) {
    Compiled c(
        bsdfNetwork({makeNode("bsdf", "ND_oren_nayar_diffuse_bsdf", {{"color", grey(0.8f)}})}));
    Bsdf bsdf;
    c.program->evaluate(seenFrom(direction(50.0f)), bsdf);
    EXPECT_NEAR(bsdf.albedo().x, 0.8f, 1e-6f);
    const glm::vec3 wi = direction(25.0f, 130.0f);
    EXPECT_NEAR(bsdf.eval(wi).diffuse.x, 0.8f * 0.31830989f * wi.z, 1e-6f);
    EXPECT_NEAR(bsdf.eval(wi).pdf, 0.31830989f * wi.z, 1e-6f);
}

TEST(Bsdf, SampleAgreesWithEval) {
    for (const Variant& v : variants) {
        Compiled c(previewNetwork(v.inputs));
        Random random(11);
        for (int i = 0; i < 400; ++i) {
            glm::vec3 wo = random.direction();
            Bsdf bsdf;
            c.program->evaluate(seenFrom(wo), bsdf);
            const BsdfSample s = bsdf.sample(random.next3(), random.next());
            if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0) continue;
            const BsdfEval e = bsdf.eval(s.wi);
            const glm::vec3 f = e.diffuse + e.specular;
            // Half vectors are rebuilt from float directions, which narrow lobes feel.
            EXPECT_NEAR(s.pdf / e.pdf, 1.0f, 2e-3f) << v.name;
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(s.weight[k], f[k] / e.pdf, 2e-3f * (1.0f + s.weight[k])) << v.name;
        }
    }
}

// Pearson's chi-squared of sample() against the pdf of eval() over 10 x 20 bins of the hemisphere.
// Significance 0.01 over 5 materials and 3 seeds; a material fails when 2 of 3 seeds reject.
TEST(Bsdf, SamplingFollowsTheDensity) {
    const int rows = 10, columns = 20, n = 100000;
    for (const size_t which : {size_t(0), size_t(2), size_t(4), size_t(5), size_t(7)}) {
        Compiled c(previewNetwork(variants[which].inputs));
        Bsdf bsdf;
        c.program->evaluate(seenFrom(direction(35.0f, 10.0f)), bsdf);
        std::vector<double> expected(rows * columns, 0.0);
        const int fine = 24;
        for (int r = 0; r < rows * fine; ++r)
            for (int k = 0; k < columns * fine; ++k) {
                const double z = (r + 0.5) / (rows * fine);
                const double phi = 6.283185307179586 * (k + 0.5) / (columns * fine);
                const double s = std::sqrt(1.0 - z * z);
                const glm::vec3 wi(float(s * std::cos(phi)), float(s * std::sin(phi)), float(z));
                expected[size_t(r / fine * columns + k / fine)] +=
                    n * bsdf.eval(wi).pdf * 6.283185307179586 / (rows * fine * columns * fine);
            }
        int rejected = 0;
        for (const uint32_t seed : {1u, 2u, 3u}) {
            Random random(seed);
            std::vector<double> counts(rows * columns, 0.0);
            for (int i = 0; i < n; ++i) {
                const BsdfSample s = bsdf.sample(random.next3(), random.next());
                if (s.event == 0 || (s.event & sh::LOBE_DELTA) != 0 || s.wi.z <= 0.0f) continue;
                double phi = std::atan2(s.wi.y, s.wi.x);
                phi += phi < 0.0 ? 6.283185307179586 : 0.0;
                const int r = std::min(rows - 1, int(s.wi.z * rows));
                const int k = std::min(columns - 1, int(phi / 6.283185307179586 * columns));
                ++counts[size_t(r * columns + k)];
            }
            // 3.4e-4 is 0.01 / 15 with margin for the quadrature.
            rejected += test::pearson(expected, counts, 5.0).tail() < 3.4e-4;
        }
        EXPECT_LT(rejected, 2) << variants[which].name;
    }
}

// A smooth reflection lobe over a transmission lobe of the same interface is the RT lobe, from both
// sides.
TEST(Bsdf, ReflectionOverTransmissionIsTheSharedInterface) {
    const Inputs smooth = {{"roughness", pair(0.0f)}};
    const auto with = [&](const char* mode) {
        Inputs inputs = smooth;
        inputs["scatter_mode"] = text(mode);
        return inputs;
    };
    Compiled layered(bsdfNetwork(
        {makeNode("r", "ND_dielectric_bsdf", with("R")),
         makeNode("t", "ND_dielectric_bsdf", with("T")),
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"r", ""}}, {"base", {"t", ""}}})}));
    Compiled whole(bsdfNetwork({makeNode("bsdf", "ND_dielectric_bsdf", with("RT"))}));
    for (const float theta : {0.0f, 20.0f, 38.0f, 45.0f, 80.0f, 120.0f, 140.0f, 179.0f}) {
        Bsdf a, b;
        layered.program->evaluate(seenFrom(direction(theta)), a);
        whole.program->evaluate(seenFrom(direction(theta)), b);
        EXPECT_NEAR(a.albedo().x, 1.0f, 1e-4f) << theta;
        EXPECT_NEAR(b.albedo().x, 1.0f, 1e-4f) << theta;
        // The share of reflection is the same, event by event.
        Random random(5);
        double reflectA = 0.0, reflectB = 0.0;
        const int n = 4000;
        for (int i = 0; i < n; ++i) {
            const glm::vec3 u = random.next3();
            const float uLobe = random.next();
            const BsdfSample sa = a.sample(u, uLobe), sb = b.sample(u, uLobe);
            reflectA += (sa.event & sh::LOBE_REFLECT) ? sa.weight.x : 0.0;
            reflectB += (sb.event & sh::LOBE_REFLECT) ? sb.weight.x : 0.0;
        }
        // Both are means of a coin: 4 standard errors of 0.5 / sqrt(n).
        EXPECT_NEAR(reflectA / n, reflectB / n, 4.0 * 0.75 / std::sqrt(double(n))) << theta;
    }
}

TEST(Bsdf, LayerOfNothingIsTheBase) {
    const NetworkNode base = makeNode("base", "ND_conductor_bsdf", {{"roughness", pair(0.3f)}});
    NetworkNode alone = base;
    alone.path = "/m/bsdf";
    Compiled plain(bsdfNetwork({alone}));
    Compiled layered(bsdfNetwork(
        {base,
         // ior 1 reflects nothing, and is not cut because it is no zero weight.
         makeNode("top", "ND_dielectric_bsdf", {{"ior", number(1.0f)}, {"roughness", pair(0.2f)}}),
         makeNode("bsdf", "ND_layer_bsdf", {}, {{"top", {"top", ""}}, {"base", {"base", ""}}})}));
    Bsdf a, b;
    plain.program->evaluate(seenFrom(direction(40.0f)), a);
    layered.program->evaluate(seenFrom(direction(40.0f)), b);
    const glm::vec3 wi = direction(35.0f, 170.0f);
    EXPECT_NEAR(a.eval(wi).specular.x, b.eval(wi).specular.x, 1e-5f);
}

TEST(Bsdf, MixAndMultiplyAreLinear) {
    const auto eval = [&](float mix, float factor) {
        Compiled c(
            bsdfNetwork({makeNode("a", "ND_oren_nayar_diffuse_bsdf", {{"color", color(1, 0, 0)}}),
                         makeNode("b", "ND_conductor_bsdf", {{"roughness", pair(0.4f)}}),
                         makeNode("amount", "ND_geompropvalue_float",
                                  {{"geomprop", text("none")}, {"default", number(mix)}}),
                         makeNode("mix", "ND_mix_bsdf", {},
                                  {{"fg", {"a", ""}}, {"bg", {"b", ""}}, {"mix", {"amount", ""}}}),
                         makeNode("bsdf", "ND_multiply_bsdfC", {{"in2", grey(factor)}},
                                  {{"in1", {"mix", ""}}})}));
        Bsdf bsdf;
        c.program->evaluate(seenFrom(direction(30.0f)), bsdf);
        const BsdfEval e = bsdf.eval(direction(25.0f, 150.0f));
        return e.diffuse + e.specular;
    };
    const glm::vec3 a = eval(1.0f, 1.0f), b = eval(0.0f, 1.0f), m = eval(0.25f, 0.5f);
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(m[k], 0.5f * (0.25f * a[k] + 0.75f * b[k]), 1e-5f);
}

TEST(Bsdf, NothingLeaksThroughABentNormal) {
    Compiled c(previewNetwork({{"diffuseColor", grey(1.0f)}, {"roughness", number(0.4f)}}));
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        ShadingPoint point;
        point.normal = glm::normalize(random.direction() + glm::vec3(0, 0, 1.02f));
        point.tangent = glm::normalize(glm::cross(point.normal, glm::vec3(0.3f, 0.8f, 0.1f)));
        point.viewDirection = random.direction();
        Bsdf bsdf;
        c.program->evaluate(point, bsdf);
        const bool front = point.viewDirection.z >= 0.0f;
        const glm::vec3 wi = random.direction();
        if ((wi.z > 0.0f) != front) {
            const BsdfEval e = bsdf.eval(wi);
            EXPECT_EQ(e.pdf, 0.0f);
            EXPECT_EQ(e.diffuse.x + e.specular.x, 0.0f);
        }
        const BsdfSample s = bsdf.sample(random.next3(), random.next());
        if (s.event != 0) {
            EXPECT_EQ(s.wi.z > 0.0f, front);
            EXPECT_TRUE(std::isfinite(s.weight.x) && s.weight.x >= 0.0f);
        }
    }
}

TEST(Bsdf, BothSidesOfAnOpaqueSurfaceLookTheSame) {
    Compiled c(previewNetwork({{"diffuseColor", grey(0.6f)}, {"clearcoat", number(1.0f)}}));
    Bsdf front, back;
    c.program->evaluate(seenFrom(direction(40.0f)), front);
    c.program->evaluate(seenFrom(-direction(40.0f)), back);
    EXPECT_NEAR(front.albedo().x, back.albedo().x, 1e-6f);
    EXPECT_GT(back.albedo().x, 0.2f);
}

TEST(Bsdf, ExtremesStayFinite) {
    const float values[] = {0.0f, 1e-6f, 0.5f, 1.0f, 1000.0f, -1.0f};
    Random random(17);
    for (int i = 0; i < 300; ++i) {
        Inputs inputs;
        for (const char* name :
             {"metallic", "roughness", "clearcoat", "clearcoatRoughness", "opacity", "ior"})
            inputs[name] = number(values[int(random.next() * 6.0f)]);
        const float c = values[int(random.next() * 6.0f)];
        inputs["diffuseColor"] = grey(c);
        Compiled compiled(previewNetwork(inputs));
        for (const float theta : {0.0f, 89.99f, 90.0f, 90.01f, 180.0f}) {
            Bsdf bsdf;
            compiled.program->evaluate(seenFrom(direction(theta)), bsdf);
            const BsdfEval e = bsdf.eval(random.direction());
            const BsdfSample s = bsdf.sample(random.next3(), random.next());
            for (const glm::vec3& v : {e.diffuse, e.specular, s.weight, bsdf.albedo()})
                for (int k = 0; k < 3; ++k)
                    EXPECT_TRUE(std::isfinite(v[k]) && v[k] >= 0.0f);
            EXPECT_TRUE(std::isfinite(e.pdf) && e.pdf >= 0.0f);
        }
    }
}

} // namespace patina
