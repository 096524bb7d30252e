// SPDX-License-Identifier: Apache-2.0
// Surfaces that lie any which way. Nothing may hang on the frame: not by a sum that is rounded
// another way, nor by a normal that is turned.
#include "materialNetwork/tests/statistics.h"

using namespace patina;

namespace {

constexpr float invPi = 0.31830989f;

struct Lossless {
    const char* name;
    Network network;
    bool smooth;             ///< each sample goes on, with all of its light
    float wavelength = 0.0f; ///< nm
};

Network openPbr(Inputs inputs) {
    inputs["transmission_weight"] = 1.0f;
    return modelNetwork("ND_open_pbr_surface_surfaceshader", inputs);
}

std::vector<Lossless> losslessMaterials() {
    const auto dielectric = [](float roughness, float film) {
        return Inputs{{"ior", 1.5f},
                      {"roughness", pair(roughness)},
                      {"thinfilm_thickness", film},
                      {"scatter_mode", "RT"}};
    };
    const auto schlick = [](float at0, float roughness, const char* mode) {
        return Inputs{
            {"color0", grey(at0)}, {"roughness", pair(roughness)}, {"scatter_mode", mode}};
    };
    const auto dispersing = [](float roughness, float scale) {
        return openPbr({{"specular_roughness", roughness},
                        {"specular_ior", 1.52f},
                        {"transmission_dispersion_abbe_number", 64.0f},
                        {"transmission_dispersion_scale", scale}});
    };
    const char* const interface = "ND_dielectric_bsdf";
    const char* const curve = "ND_generalized_schlick_bsdf";
    const auto slab = [&](float film) {
        return lobeNetwork(interface, dielectric(0.0f, film), {{"thin_walled", true}});
    };
    return {
        {"glass", lobeNetwork(interface, dielectric(0.0f, 0.0f)), true},
        {"rough glass", lobeNetwork(interface, dielectric(0.3f, 0.0f)), false},
        {"glass under a film", lobeNetwork(interface, dielectric(0.0f, 400.0f)), true},
        {"slab", slab(0.0f), true},
        {"slab under a film", slab(400.0f), true},
        {"curve of both sides", lobeNetwork(curve, schlick(0.2f, 0.0f, "RT")), true},
        {"mirror", lobeNetwork(curve, schlick(1.0f, 0.0f, "R")), true},
        {"rough mirror", lobeNetwork(curve, schlick(1.0f, 0.5f, "R")), false},
        {"diffuse",
         lobeNetwork("ND_oren_nayar_diffuse_bsdf",
                     {{"color", grey(1.0f)}, {"roughness", 1.0f}, {"energy_compensation", true}}),
         false},
        {"translucent", lobeNetwork("ND_translucent_bsdf", {}), false},
        {"dispersing glass", dispersing(0.0f, 1.0f), true, 450.0f},
        {"hardly dispersing glass", dispersing(0.0f, 0.01f), true, 650.0f},
        {"rough dispersing glass", dispersing(0.4f, 1.0f), false, 550.0f},
        {"soap bubble",
         openPbr({{"specular_roughness", 0.0f},
                  {"specular_ior", 1.0f},
                  {"thin_film_weight", 1.0f},
                  {"geometry_thin_walled", true}}),
         true},
    };
}

/// A surface that lies at random. @param wo in its own frame
ShadingPoint anyPoint(Random& random, const glm::vec3& wo) {
    ShadingPoint point;
    point.normal = point.geometricNormal = random.direction();
    point.tangent = glm::normalize(glm::cross(point.normal, random.direction()));
    point.bitangent = glm::cross(point.normal, point.tangent);
    point.viewDirection = point.tangent * wo.x + point.bitangent * wo.y + point.normal * wo.z;
    return point;
}

/// A direction that is no lower than that.
glm::vec3 anyView(Random& random, float low) {
    glm::vec3 wo = random.direction();
    wo.z = std::copysign(std::max(std::fabs(wo.z), low), wo.z);
    return glm::normalize(wo);
}

/// What a path does at a surface: passes straight on, or draws from its lobes.
BsdfSample drawWhole(const Bsdf& bsdf, float presence, const glm::vec3& passes, Random& random) {
    if (random.next() < presence) return drawn(bsdf, random);
    BsdfSample s;
    s.weight = passes;
    s.event = sh::LOBE_TRANSMIT | sh::LOBE_DELTA;
    return s;
}

} // namespace

// Rough lobes are known to 4e-3, by their tables. A mean of samples may be five standard errors
// off: p = 6e-7 for each of 3 channels of 14 materials, with one seed.
TEST(TiltedFurnace, NothingIsLostHoweverASurfaceLies) {
    for (const Lossless& m : losslessMaterials()) {
        SCOPED_TRACE(m.name);
        const Compiled c(m.network);
        ASSERT_TRUE(nothingTold(c));
        Random random(17);
        constexpr int points = 100, draws = 40;
        Mean weight[3];
        for (int i = 0; i < points; ++i) {
            ShadingPoint point = anyPoint(random, anyView(random, 0.05f));
            point.wavelength = m.wavelength;
            glm::vec3 passes(0.0f);
            const float presence = c->opacity(point, &passes);
            const Bsdf bsdf = c.lobes(point);
            expectVector(presence * bsdf.albedo() + (1.0f - presence) * passes, glm::vec3(1.0f),
                         m.smooth ? 1e-4f : 4e-3f);
            for (int k = 0; k < draws; ++k) {
                const BsdfSample s = drawWhole(bsdf, presence, passes, random);
                if (m.smooth) {
                    ASSERT_NE(s.event, 0);
                    // A channel goes one of two ways, of which either is taken by the mean of
                    // three.
                    EXPECT_LE(std::max({s.weight.x, s.weight.y, s.weight.z}), 3.001f);
                }
                for (int channel = 0; channel < 3; ++channel)
                    weight[channel].add(double(s.weight[channel]));
            }
        }
        for (const Mean& w : weight)
            EXPECT_NEAR(w.mean(), 1.0, 5.0 * std::sqrt(w.variance()) + (m.smooth ? 1e-4 : 4e-3));
    }
}

// Normals are turned for mirrors alone, which show black where they reflect the inside of their own
// surface.
TEST(TiltedFurnace, DiffuseLobesKeepTheNormalThatIsGiven) {
    const float share = 0.48f;
    for (const char* id :
         {"ND_oren_nayar_diffuse_bsdf", "ND_subsurface_bsdf", "ND_translucent_bsdf"}) {
        Compiled c(lobeNetwork(id, {{"color", grey(share)}}));
        const bool transmits = std::string(id) == "ND_translucent_bsdf";
        Random random(5);
        int turnedAway = 0;
        for (int i = 0; i < 2000; ++i) {
            ShadingPoint point = anyPoint(random, random.direction());
            const glm::vec3 g = point.geometricNormal;
            point.normal = glm::normalize(g + 0.99f * random.direction());
            const float side = glm::dot(point.viewDirection, g) >= 0.0f ? 1.0f : -1.0f;
            const glm::vec3 n = point.normal * side;
            turnedAway += glm::dot(n, point.viewDirection) < 0.0f;
            const glm::vec3 wi = random.direction();
            const bool above = glm::dot(wi, g) * side > 0.0f;
            const Bsdf bsdf = c.lobes(point);
            const float cosine = transmits ? -glm::dot(n, wi) : glm::dot(n, wi);
            const float expected =
                above != transmits ? share * invPi * std::max(cosine, 0.0f) : 0.0f;
            EXPECT_NEAR(bsdf.eval(wi).diffuse.x, expected, 1e-6f) << id << " " << i;
            const BsdfSample s = drawn(bsdf, random);
            if (s.event != 0) {
                EXPECT_NEAR(s.weight.x, share, 1e-6f) << id;
                EXPECT_NEAR(s.pdf, invPi * std::fabs(glm::dot(n, s.wi)), 1e-6f) << id;
            }
        }
        EXPECT_GT(turnedAway, 100) << id;
    }
}

TEST(TiltedFurnace, MirrorsReflectAboveTheirSurfaceWhateverTheirNormal) {
    Compiled c(lobeNetwork("ND_generalized_schlick_bsdf",
                           {{"color0", grey(1.0f)}, {"roughness", pair(0.0f)}}));
    Random random(6);
    for (int i = 0; i < 2000; ++i) {
        ShadingPoint point = anyPoint(random, anyView(random, 0.01f));
        point.normal = glm::normalize(point.geometricNormal + 0.99f * random.direction());
        EXPECT_NE(drawn(c.lobes(point), random).event, 0) << i;
    }
}
