// SPDX-License-Identifier: Apache-2.0
// Renders a red ball under a white sky: host IMAGE [BACKEND]
#include <patina.h>

#include <glm/gtc/matrix_transform.hpp>

#include <cstdio>

using namespace patina;

static std::shared_ptr<Scene> makeScene() {
    auto scene = std::make_shared<Scene>();
    SceneEdit edit = scene->edit(); // commits when it ends

    auto red = std::make_shared<MaterialPrim>();
    red->path = red->network.path = "/red";
    NetworkNode bsdf{"/red/bsdf", "ND_oren_nayar_diffuse_bsdf", {}, {}};
    bsdf.inputs["color"] = Value::makeColor3(0.8f, 0.1f, 0.05f);
    NetworkNode surface{"/red/surface", "ND_surface", {}, {}};
    surface.connections["bsdf"] = {"/red/bsdf", ""};
    red->network.nodes = {bsdf, surface};
    red->network.terminals["surface"] = {"/red/surface", ""};
    edit.set(red);

    auto ball = std::make_shared<Implicit>();
    ball->path = "/ball";
    ball->material = "/red";
    edit.set(ball);

    auto sky = std::make_shared<Light>();
    sky->path = "/sky";
    sky->type = LightType::Dome;
    edit.set(sky);

    auto camera = std::make_shared<Camera>();
    camera->path = "/camera";
    camera->transform = glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 8.0));
    edit.set(camera);
    return scene;
}

int main(int count, char** arguments) {
    if (count < 2) return std::fprintf(stderr, "host IMAGE [BACKEND]\n"), 2;
    const auto renderer = makeBackend(count > 2 ? arguments[2] : "embree");
    if (!renderer) return std::fprintf(stderr, "host: no such back end\n"), 2;
    const auto scene = makeScene();
    const auto film = std::make_shared<Film>();
    RenderSettings settings;
    settings.width = 64, settings.height = 48, settings.samples = 16;
    renderer->start(scene, "/camera", settings, film);
    renderer->wait();
    if (renderer->progress().failed)
        return std::fprintf(stderr, "host: %s\n", renderer->progress().error.c_str()), 1;
    for (const auto& warning : scene->diagnostics().all())
        std::fprintf(stderr, "%s: %s\n", warning.prim.c_str(), warning.message.c_str());
    writeImage(*film, arguments[1]);
    return 0;
}
