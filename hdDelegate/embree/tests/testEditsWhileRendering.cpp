// SPDX-License-Identifier: Apache-2.0
// Random edits by several threads while the path tracer renders. PATINA_EDITS sets how many each of
// them makes, PATINA_EDITS_SEED which; testenv/sanitizers/racingEdits.py runs it for long under
// ThreadSanitizer.
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"
#include "base/tests/testTools.h"
#include "materialNetwork/tests/materialFixture.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <random>

using namespace patina;

namespace {

constexpr int editors = 2;
constexpr int editsPerStart = 4; ///< of each editor, at most

/// @returns a number that the environment tells, or another
int told(const char* name, int otherwise) {
    const char* text = std::getenv(name);
    return text ? std::atoi(text) : otherwise;
}

/// One of the threads that edit: its random numbers, and the prims that only it touches. Those of
/// "/shared" are everyone's.
class Editor {
public:
    Editor(Scene& scene, int number)
        : _scene(scene), _random(unsigned(editors * told("PATINA_EDITS_SEED", 40) + number)),
          _own("/editor" + std::to_string(number)) {}

    void edit() {
        SceneEdit edit = _scene.edit();
        for (int i = below(3); i >= 0; --i)
            change(edit);
    }

private:
    int below(int count) { return int(_random() % unsigned(count)); }
    float number(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(_random);
    }
    std::string path(const char* kind) {
        return (below(2) ? _own : std::string("/shared")) + "/" + kind + std::to_string(below(3));
    }
    mat4 place() {
        return translate(number(-3, 3), number(-2, 2), number(-3, 0)) *
               glm::scale(mat4(1.0f), vec3(number(0.2f, 1.0f)));
    }

    void change(SceneEdit& edit) {
        switch (below(9)) {
        case 0: return edit.remove(path(below(2) ? "mesh" : "light"));
        case 1: return setMaterial(edit);
        case 2: return setLight(edit);
        case 3: return setInstancer(edit);
        case 4: return setCamera(edit);
        case 5: return setBall(edit);
        default: return setMesh(edit);
        }
    }

    void setMesh(SceneEdit& edit) {
        auto mesh = std::make_shared<Mesh>(cubeMesh());
        mesh->path = path("mesh");
        mesh->transform = place();
        mesh->material = path("material");
        if (below(4) == 0) mesh->group = "prototype";
        if (below(3) == 0) mesh->scheme = SubdivisionScheme::CatmullClark;
        edit.set(mesh);
    }

    void setBall(SceneEdit& edit) {
        auto ball = makePrim<Implicit>(path("ball"), place());
        edit.set(ball);
    }

    void setMaterial(SceneEdit& edit) {
        Inputs inputs = {{"diffuseColor", color(number(0, 1), 0.5f, 0.2f)}};
        if (below(3) == 0) inputs["emissiveColor"] = color(number(0, 4), 1, 1);
        if (below(3) == 0) inputs["clearcoat"] = patina::number(number(0, 1));
        edit.set(
            makeMaterial(path("material"), {makeNode("surface", "UsdPreviewSurface", inputs)}));
    }

    void setLight(SceneEdit& edit) {
        auto light = makePrim<Light>(path("light"));
        const LightType types[] = {LightType::Dome, LightType::Distant, LightType::Rect,
                                   LightType::Sphere};
        light->type = types[below(4)];
        light->intensity = number(0, 3);
        light->transform = place();
        edit.set(light);
    }

    void setInstancer(SceneEdit& edit) {
        const std::string at = path("instancer");
        std::vector<mat4> places;
        for (int i = below(4); i >= 0; --i)
            places.push_back(place());
        edit.set(makeInstancer(at, "", "prototype", places));
    }

    void setCamera(SceneEdit& edit) {
        edit.set(makePrim<Camera>("/camera", translate(number(-1, 1), 0.5f, number(6, 9))));
    }

    Scene& _scene;
    std::mt19937 _random;
    std::string _own;
};

RenderSettings small(int samples) {
    RenderSettings settings = imageOf(24, 16, samples);
    settings.threads = 3;
    return settings;
}

std::vector<float> colorOf(Renderer& renderer, const std::shared_ptr<Scene>& scene) {
    const auto film = rendered(renderer, scene, small(2));
    EXPECT_FALSE(renderer.progress().failed) << renderer.progress().error;
    return film->resolve("color");
}

} // namespace

TEST(EditsWhileRendering, EndWithTheImageOfAFreshRenderer) {
    auto scene = sceneOf(makePrim<Camera>("/camera", translate(0, 0.5f, 8)));
    auto renderer = makeRenderer("embree");
    std::atomic<int> working{editors}, starts{0};
    std::vector<std::thread> threads;
    const int edits = told("PATINA_EDITS", 60);
    for (int number = 0; number < editors; ++number)
        threads.emplace_back([&, number] {
            Editor editor(*scene, number);
            for (int i = 0; i < edits; ++i) {
                // Relaxed: any stronger order would hide races from the sanitizer.
                while (i > editsPerStart * (starts.load(std::memory_order_relaxed) + 1))
                    std::this_thread::sleep_for(std::chrono::microseconds(100));
                editor.edit();
                std::this_thread::sleep_for(std::chrono::microseconds(200 * (i % 5)));
            }
            working.fetch_sub(1, std::memory_order_relaxed);
        });
    std::mt19937 random(unsigned(told("PATINA_EDITS_SEED", 40)));
    auto film = std::make_shared<Film>();
    while (working.load(std::memory_order_relaxed) > 0) {
        if (random() % 3 == 0) film = std::make_shared<Film>();
        renderer->start(scene, "/camera", small(int(1 + random() % 8)), film);
        starts.fetch_add(1, std::memory_order_relaxed);
        std::this_thread::sleep_for(std::chrono::microseconds(random() % 4000));
        if (random() % 4 == 0) {
            renderer->pause();
            renderer->progress();
            renderer->resume();
        }
        if (random() % 4 == 0) renderer->stop();
        if (random() % 8 == 0) renderer->wait();
        EXPECT_FALSE(renderer->progress().failed) << renderer->progress().error;
    }
    for (std::thread& thread : threads)
        thread.join();
    renderer->stop();
    auto fresh = makeRenderer("embree");
    const auto edited = colorOf(*renderer, scene);
    EXPECT_TRUE(sameBits(edited, colorOf(*fresh, scene)));
    for (float value : edited)
        ASSERT_TRUE(std::isfinite(value));
    EXPECT_GE(starts, edits / editsPerStart - 1);
}
