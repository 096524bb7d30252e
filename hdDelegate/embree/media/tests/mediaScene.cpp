// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/tests/mediaScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace patina::test {

namespace {

template <class T> std::shared_ptr<T> place(const std::string& path, const mat4& transform) {
    auto prim = std::make_shared<T>();
    prim->path = path;
    prim->transform = MotionTransform(transform);
    return prim;
}

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
    auto prim = std::make_shared<MaterialPrim>();
    prim->path = path;
    prim->network.path = path;
    prim->network.terminals[terminal] = {nodes.at(0).path, ""};
    prim->network.nodes = std::move(nodes);
    scene->edit().set(std::shared_ptr<const MaterialPrim>(prim));
}

void MediaScene::cube(const std::string& path, const vec3& center, const vec3& size,
                      const std::string& material) {
    auto prim = place<Implicit>(path, placed(center, 0.5f * size));
    prim->shape = ImplicitShape::Cube;
    prim->material = material;
    scene->edit().set(std::shared_ptr<const Geometry>(prim));
}

void MediaScene::sphere(const std::string& path, const vec3& center, float radius,
                        const std::string& material) {
    auto prim = place<Implicit>(path, placed(center, vec3(radius)));
    prim->material = material;
    scene->edit().set(std::shared_ptr<const Geometry>(prim));
}

void MediaScene::plane(const std::string& path, const vec3& center, float size,
                       const std::string& material) {
    auto prim = place<Implicit>(path, placed(center, vec3(1.0f)));
    prim->shape = ImplicitShape::Plane;
    prim->width = prim->length = size;
    prim->material = material;
    scene->edit().set(std::shared_ptr<const Geometry>(prim));
}

void MediaScene::dome(float radiance) {
    auto light = std::make_shared<Light>();
    light->path = "/dome";
    light->type = LightType::Dome;
    light->intensity = radiance;
    scene->edit().set(std::shared_ptr<const Light>(light));
}

void MediaScene::distant(const vec3& irradiance, const vec3& travels) {
    auto light = std::make_shared<Light>();
    light->path = "/sun";
    light->type = LightType::Distant;
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
    scene->edit().set(std::shared_ptr<const Light>(light));
}

void MediaScene::camera(const vec3& eye, float width) {
    auto camera = place<Camera>("/camera", placed(eye, vec3(1.0f)));
    camera->orthographic = true;
    camera->clipNear = 0.01f; // where no box has a face: which side it is on would hang on rounding
    // Apertures are tenths of scene units.
    camera->horizontalAperture = camera->verticalAperture = 10.0f * width;
    scene->edit().set(std::shared_ptr<const Camera>(camera));
}

MediaScene::Image MediaScene::render(int pixels, int samples) {
    settings.width = settings.height = pixels;
    settings.samples = samples;
    settings.filterRadius = 0.5f;
    auto renderer = makeRenderer("embree");
    auto film = std::make_shared<Film>();
    renderer->start(scene, "/camera", settings, film);
    renderer->wait();
    Image image;
    image.color = film->resolve("color");
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

NetworkNode node(const std::string& path, const std::string& id,
                 std::map<std::string, Value> inputs,
                 std::map<std::string, Connection> connections) {
    NetworkNode result;
    result.path = path;
    result.id = id;
    result.inputs = std::move(inputs);
    result.connections = std::move(connections);
    return result;
}

static Value vec(const vec3& v) {
    return Value::makeVec3(v.x, v.y, v.z);
}

std::vector<NetworkNode> volumeNodes(const vec3& absorption, const vec3& scattering,
                                     float anisotropy) {
    return {node("/m/volume", "ND_volume", {}, {{"vdf", {"/m/vdf", ""}}}),
            node("/m/vdf", "ND_anisotropic_vdf",
                 {{"absorption", vec(absorption)},
                  {"scattering", vec(scattering)},
                  {"anisotropy", Value::makeFloat(anisotropy)}})};
}

std::vector<NetworkNode> glassNodes(float ior, float roughness, const vec3& absorption,
                                    const vec3& scattering) {
    return {
        node("/m/surface", "ND_surface", {}, {{"bsdf", {"/m/layer", ""}}}),
        node("/m/layer", "ND_layer_vdf", {}, {{"top", {"/m/glass", ""}}, {"base", {"/m/vdf", ""}}}),
        node("/m/glass", "ND_dielectric_bsdf",
             {{"ior", Value::makeFloat(ior)},
              {"roughness", Value::makeVec2(roughness, roughness)},
              {"scatter_mode", Value::makeString("RT")}}),
        node("/m/vdf", "ND_anisotropic_vdf",
             {{"absorption", vec(absorption)}, {"scattering", vec(scattering)}})};
}

} // namespace patina::test
