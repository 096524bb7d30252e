// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/renderer/renderer.h"
#include "materialNetwork/tests/materialFixture.h"

#include <functional>

namespace patina::test {

/// A scene for one test: prims are added, then one image is rendered.
class MediaScene {
public:
    MediaScene() : scene(std::make_shared<Scene>()) {}

    std::shared_ptr<Scene> scene;
    RenderSettings settings;

    /// @param nodes of the material; the first is the one on the terminal
    void material(const std::string& path, std::vector<NetworkNode> nodes,
                  const std::string& terminal = "surface");
    void cube(const std::string& path, const vec3& center, const vec3& size,
              const std::string& material);
    void sphere(const std::string& path, const vec3& center, float radius,
                const std::string& material);
    /// A square that faces along z.
    void plane(const std::string& path, const vec3& center, float size,
               const std::string& material);
    void dome(float radiance);
    /// A dome of radiance 1 and a camera above z = 0.
    void whiteRoom(float width) {
        dome(1.0f);
        camera(vec3(0, 0, 5), width);
    }
    void distant(const vec3& irradiance, const vec3& travels);
    /// Looks along -z from `eye`, orthographic, on a square of that width.
    void camera(const vec3& eye, float width);

    struct Image {
        std::vector<float> color;
        vec3 mean{0.0f}, error{0.0f}; ///< over pixels; error: standard deviation of the mean
        bool finite = true;
        double raysPerPath = 0.0;
    };
    Image render(int pixels, int samples);
};

/// Significance: five standard errors. @param slack more, for what the test says
void expectMean(const MediaScene::Image& image, const vec3& wanted, float slack);

/// Renders a scene with one thread, and with two: the images must be the same.
void expectThreadsChangeNothing(int pixels, int samples,
                                const std::function<void(MediaScene&)>& fill);

/// Every channel is a number that light may have.
void expectSane(const MediaScene::Image& image);

inline Value rgb(const vec3& v) {
    return Value::makeColor3(v.x, v.y, v.z);
}
inline Value vec(const vec3& v) {
    return Value::makeVec3(v.x, v.y, v.z);
}

/// "/m" as a ball of radius 1 around the origin.
MediaScene ball(std::vector<NetworkNode> nodes, const std::string& terminal = "surface");
/// "/m" below z = 0, wide and deep.
MediaScene block(std::vector<NetworkNode> nodes);

/// ND_surface of one BSDF.
std::vector<NetworkNode> surfaceOf(const std::string& bsdf, Inputs inputs, Inputs surface = {});
inline std::vector<NetworkNode> whiteNodes() {
    return surfaceOf("ND_oren_nayar_diffuse_bsdf", {{"color", grey(1)}});
}

/// ND_volume over an ND_anisotropic_vdf of these coefficients.
std::vector<NetworkNode> volumeNodes(const vec3& absorption, const vec3& scattering,
                                     float anisotropy = 0.0f);

/// ND_surface of an ND_dielectric_bsdf, RT, over an anisotropic VDF.
std::vector<NetworkNode> glassNodes(float ior, float roughness, const vec3& absorption,
                                    const vec3& scattering);

} // namespace patina::test
