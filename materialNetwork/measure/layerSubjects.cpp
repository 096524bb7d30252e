// SPDX-License-Identifier: Apache-2.0
#include "materialNetwork/measure/layerSubjects.h"

#include "materialNetwork/cpu/bsdf.h"
#include "materialNetwork/cpu/materialProgram.h"

#include <cmath>

namespace patina::measure {

namespace {

constexpr float coatIor = 1.5f;

/// There are none.
class NoTextures : public TextureSource {
public:
    int open(const TextureRequest&) override { return 0; }
    bool valid(int) const override { return false; }
    glm::vec4 sample(int, glm::vec2, float) const override { return glm::vec4(0.0f); }
    int channels(int) const override { return 0; }
    std::shared_ptr<const EmissionProfile> openProfile(const TextureRequest&) override {
        return nullptr;
    }
};

/// Number i of a sequence that fills the unit cube evenly (Roberts 2018, four dimensions).
glm::vec4 spread(int i) {
    constexpr double steps[] = {0.8566748838545029, 0.7338918566271260, 0.6287067210378087,
                                0.5385972572236101};
    glm::vec4 u;
    for (int k = 0; k < 4; ++k) {
        const double x = 0.5 + steps[k] * (i + 1);
        u[k] = std::min(float(x - std::floor(x)), 0.99999994f);
    }
    return u;
}

NetworkNode node(const char* path, const char* id) {
    NetworkNode result;
    result.path = path;
    result.id = id;
    return result;
}

ShadingPoint seenFrom(double cosine) {
    ShadingPoint point;
    point.viewDirection = glm::vec3(float(std::sqrt(1.0 - cosine * cosine)), 0.0f, float(cosine));
    return point;
}

} // namespace

std::shared_ptr<const MaterialProgram> layered(const Base& base, double alpha,
                                               const MethodChoices& methods) {
    NetworkNode below = node("/base", "ND_oren_nayar_diffuse_bsdf");
    if (base.extinction > 0.0) {
        const float n = float(base.ior), k = float(base.extinction), a = float(base.alpha);
        below = node("/base", "ND_conductor_bsdf");
        below.inputs["ior"] = Value::makeColor3(n, n, n);
        below.inputs["extinction"] = Value::makeColor3(k, k, k);
        below.inputs["roughness"] = Value::makeVec2(a, a);
    } else {
        const float grey = float(base.grey);
        below.inputs["color"] = Value::makeColor3(grey, grey, grey);
    }
    NetworkNode top = node("/top", "ND_dielectric_bsdf"), layer = node("/layer", "ND_layer_bsdf"),
                surface = node("/surface", "ND_surface");
    top.inputs["ior"] = Value::makeFloat(coatIor);
    top.inputs["roughness"] = Value::makeVec2(float(alpha), float(alpha));
    layer.connections["top"] = {"/top", ""};
    layer.connections["base"] = {"/base", ""};
    surface.connections["bsdf"] = {alpha < 0.0 ? "/base" : "/layer", ""};
    Network network;
    network.path = "/layers";
    network.nodes = {below, top, layer, surface};
    network.terminals["surface"] = {"/surface", ""};
    NoTextures textures;
    Diagnostics silent;
    return compileMaterial(network, textures, silent, methods);
}

Albedo sampledAlbedo(const MaterialProgram& program, double cosine, int samples) {
    const ShadingPoint point = seenFrom(cosine);
    Bsdf bsdf;
    program.evaluate(point, bsdf);
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < samples; ++i) {
        bsdf.seed(uint32_t(i));
        const glm::vec4 u = spread(i);
        const BsdfSample s = bsdf.sample(glm::vec3(u), u.w);
        const double w = s.event ? double(s.weight.x) : 0.0;
        sum += w;
        squares += w * w;
    }
    const double mean = sum / samples;
    return {mean, std::sqrt(std::max(squares / samples - mean * mean, 0.0) / samples)};
}

double knownAlbedo(const MaterialProgram& program, double cosine) {
    Bsdf bsdf;
    program.evaluate(seenFrom(cosine), bsdf);
    return double(bsdf.albedo().x);
}

void timeEvaluations(const std::vector<std::shared_ptr<const MaterialProgram>>& programs,
                     Row& row) {
    time(
        [&](int n) {
            double sum = 0.0;
            for (int i = 0; i < n; ++i) {
                const glm::vec4 u = spread(i);
                const ShadingPoint point = seenFrom(0.02 + 0.96 * double(u.x));
                Bsdf bsdf;
                programs[size_t(i) * 37 % programs.size()]->evaluate(point, bsdf);
                bsdf.seed(uint32_t(i));
                const BsdfSample s = bsdf.sample(glm::vec3(u.y, u.z, u.w), u.x);
                const glm::vec3 up = glm::normalize(glm::vec3(u.z - 0.5f, u.w - 0.5f, 0.5f));
                const BsdfEval e = bsdf.eval(up);
                sum += double(s.weight.x + e.diffuse.x + e.specular.x);
            }
            return sum;
        },
        512, row);
}

} // namespace patina::measure
