// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/tests/mediaScene.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"

namespace patina::test {

namespace {

mat4 placed(const vec3& center, const vec3& scale) {
    mat4 m(1.0f);
    for (int i = 0; i < 3; ++i)
        m[i][i] = scale[i];
    m[3] = vec4(center, 1.0f);
    return m;
}

} // namespace

void MediaScene::material(const std::string& path, std::vector<NetworkNode> nodes,
                          const std::string& terminal) {
    scene->edit().set(makeMaterial(path, std::move(nodes), terminal));
}

void MediaScene::cube(const std::string& path, const vec3& center, const vec3& size,
                      const std::string& material) {
    auto prim = makePrim<Implicit>(path, placed(center, 0.5f * size));
    prim->shape = ImplicitShape::Cube;
    prim->material = material;
    scene->edit().set(prim);
}

void MediaScene::sphere(const std::string& path, const vec3& center, float radius,
                        const std::string& material) {
    auto prim = makePrim<Implicit>(path, placed(center, vec3(radius)));
    prim->material = material;
    scene->edit().set(prim);
}

void MediaScene::plane(const std::string& path, const vec3& center, float size,
                       const std::string& material) {
    auto prim = makePrim<Implicit>(path, placed(center, vec3(1.0f)));
    prim->shape = ImplicitShape::Plane;
    prim->width = prim->length = size;
    prim->material = material;
    scene->edit().set(prim);
}

void MediaScene::dome(float radiance) {
    auto light = makeLight("/dome", LightType::Dome);
    light->intensity = radiance;
    scene->edit().set(light);
}

void MediaScene::distant(const vec3& irradiance, const vec3& travels) {
    auto light = makeLight("/sun", LightType::Distant);
    light->angle = 0.0f;
    light->color = irradiance;
    const vec3 z = -glm::normalize(travels);
    const vec3 x =
        glm::normalize(glm::cross(std::abs(z.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0), z));
    mat4 m(1.0f);
    m[0] = vec4(x, 0);
    m[1] = vec4(glm::cross(z, x), 0);
    m[2] = vec4(z, 0);
    light->transform = MotionTransform(m);
    scene->edit().set(light);
}

void MediaScene::camera(const vec3& eye, float width) {
    auto camera = makePrim<Camera>("/camera", placed(eye, vec3(1.0f)));
    camera->orthographic = true;
    camera->clipNear = 0.01f; // where no box has a face: which side it is on would hang on rounding
    // Apertures are tenths of scene units.
    camera->horizontalAperture = camera->verticalAperture = 10.0f * width;
    scene->edit().set(camera);
}

MediaScene::Image MediaScene::render(int pixels, int samples) {
    settings.width = settings.height = pixels;
    settings.samples = samples;
    settings.filterRadius = 0.5f;
    auto renderer = makeRenderer("embree");
    Image image;
    image.color = rendered(*renderer, scene, settings)->resolve("color");
    const auto counts = renderer->progress().statistics;
    image.raysPerPath = counts.at("rays") / counts.at("paths");
    const int n = pixels * pixels;
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < n; ++i) {
            const double x = image.color[size_t(i) * 3 + c];
            image.finite &= std::isfinite(x);
            sum += x;
            squares += x * x;
        }
        image.mean[c] = float(sum / n);
        image.error[c] = float(std::sqrt(std::max(squares / n - sum / n * sum / n, 0.0) / n));
    }
    return image;
}

void expectMean(const MediaScene::Image& image, const vec3& wanted, float slack) {
    EXPECT_TRUE(image.finite);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(image.mean[c], wanted[c], 5.0f * image.error[c] + slack) << c;
}

void expectThreadsChangeNothing(int pixels, int samples,
                                const std::function<void(MediaScene&)>& fill) {
    std::vector<float> images[2];
    for (int threads : {1, 2}) {
        MediaScene s;
        s.settings.threads = threads;
        fill(s);
        images[threads - 1] = s.render(pixels, samples).color;
    }
    EXPECT_EQ(images[0], images[1]);
}

void expectSane(const MediaScene::Image& image) {
    ASSERT_TRUE(image.finite);
    for (float x : image.color)
        ASSERT_TRUE(x >= 0.0f && x < 100.0f) << x;
}

MediaScene ball(std::vector<NetworkNode> nodes, const std::string& terminal) {
    MediaScene s;
    s.material("/m", std::move(nodes), terminal);
    s.sphere("/ball", vec3(0), 1.0f, "/m");
    return s;
}

MediaScene block(std::vector<NetworkNode> nodes) {
    MediaScene s;
    s.material("/m", std::move(nodes));
    s.cube("/block", vec3(0, 0, -10), vec3(20), "/m");
    return s;
}

std::vector<NetworkNode> surfaceOf(const std::string& bsdf, Inputs inputs, Inputs surface) {
    return {makeNode("surface", "ND_surface", std::move(surface), {{"bsdf", {"bsdf", ""}}}),
            makeNode("bsdf", bsdf, std::move(inputs))};
}

std::vector<NetworkNode> volumeNodes(const vec3& absorption, const vec3& scattering,
                                     float anisotropy) {
    return {makeNode("volume", "ND_volume", {}, {{"vdf", {"vdf", ""}}}),
            makeNode("vdf", "ND_anisotropic_vdf",
                     {{"absorption", vec(absorption)},
                      {"scattering", vec(scattering)},
                      {"anisotropy", number(anisotropy)}})};
}

std::vector<NetworkNode> glassNodes(float ior, float roughness, const vec3& absorption,
                                    const vec3& scattering) {
    return {
        makeNode("surface", "ND_surface", {}, {{"bsdf", {"layer", ""}}}),
        makeNode("layer", "ND_layer_vdf", {}, {{"top", {"glass", ""}}, {"base", {"vdf", ""}}}),
        makeNode(
            "glass", "ND_dielectric_bsdf",
            {{"ior", number(ior)}, {"roughness", pair(roughness)}, {"scatter_mode", text("RT")}}),
        makeNode("vdf", "ND_anisotropic_vdf",
                 {{"absorption", vec(absorption)}, {"scattering", vec(scattering)}})};
}

} // namespace patina::test
