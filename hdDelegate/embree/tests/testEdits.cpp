// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "hdDelegate/image/fieldGrid.h"
#include "hdDelegate/renderer/renderer.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <thread>

using namespace patina;

namespace {

mat4 translate(float x, float y, float z) {
    return glm::translate(mat4(1.0f), vec3(x, y, z));
}

std::shared_ptr<const MaterialPrim> makeMaterial(const std::string& path, float red, float glow) {
    auto material = std::make_shared<MaterialPrim>();
    material->path = path;
    material->network.path = path;
    NetworkNode node;
    node.path = path + "/surface";
    node.id = "UsdPreviewSurface";
    node.inputs["diffuseColor"] = Value::makeColor3(red, 0.5f, 0.2f);
    if (glow > 0.0f) node.inputs["emissiveColor"] = Value::makeColor3(glow, glow, 1.0f);
    material->network.nodes.push_back(node);
    material->network.terminals["surface"] = {node.path, ""};
    return material;
}

std::shared_ptr<Mesh> makeCube(const std::string& path, const mat4& transform,
                               const std::string& group = "") {
    auto mesh = std::make_shared<Mesh>(cubeMesh());
    mesh->path = path;
    mesh->group = group;
    mesh->transform = transform;
    return mesh;
}

std::shared_ptr<const Camera> makeCamera(float z) {
    auto camera = std::make_shared<Camera>();
    camera->path = "/camera";
    camera->transform = translate(0, 0.5f, z);
    return camera;
}

std::shared_ptr<Instancer> makeInstancer(const std::string& path, const std::string& group,
                                         const std::string& prototype, float step) {
    auto instancer = std::make_shared<Instancer>();
    instancer->path = path;
    instancer->group = group;
    instancer->prototypes = {prototype};
    for (int i = 0; i < 3; ++i) {
        instancer->transforms.push_back(translate(step * float(i - 1), 0.3f * float(i), -2));
        instancer->prototypeIndices.push_back(0);
    }
    return instancer;
}

template <class T, class U> void put(Scene& scene, const std::shared_ptr<U>& prim) {
    scene.edit().set(std::shared_ptr<const T>(prim));
}

/// Everything at once: prims in the world, two levels of instances, lights and something that
/// glows.
std::shared_ptr<Scene> makeScene() {
    auto scene = std::make_shared<Scene>();
    SceneEdit edit = scene->edit();
    auto cube = makeCube("/cube", translate(-2, 0, 0));
    cube->material = "/red";
    edit.set(std::shared_ptr<const Geometry>(cube));
    auto smooth = makeCube("/smooth", translate(2, 0, 0));
    smooth->scheme = SubdivisionScheme::CatmullClark;
    edit.set(std::shared_ptr<const Geometry>(smooth));
    auto lamp = makeCube("/lamp", translate(0, 3, 0) * glm::scale(mat4(1.0f), vec3(0.3f)));
    lamp->material = "/glow";
    edit.set(std::shared_ptr<const Geometry>(lamp));
    edit.set(std::shared_ptr<const Geometry>(
        makeCube("/leaf", glm::scale(mat4(1.0f), vec3(0.4f)), "A")));
    edit.set(std::shared_ptr<const Geometry>(
        makeCube("/other", glm::scale(mat4(1.0f), vec3(0.2f)), "C")));
    edit.set(std::shared_ptr<const Instancer>(makeInstancer("/i1", "B", "A", 1.0f)));
    edit.set(std::shared_ptr<const Instancer>(makeInstancer("/i2", "", "B", 3.0f)));
    edit.set(std::shared_ptr<const Instancer>(makeInstancer("/i3", "", "C", 2.0f)));
    edit.set(makeMaterial("/red", 0.8f, 0.0f));
    edit.set(makeMaterial("/glow", 0.0f, 5.0f));
    auto dome = std::make_shared<Light>();
    dome->path = "/dome";
    dome->type = LightType::Dome;
    edit.set(std::shared_ptr<const Light>(dome));
    edit.set(makeCamera(9));
    return scene;
}

RenderSettings small(bool interactive) {
    RenderSettings settings;
    settings.width = 48;
    settings.height = 32;
    settings.samples = 2;
    settings.interactive = interactive;
    settings.aovs = {"primId", "instanceId", "normal"};
    return settings;
}

/// Also where ids make numbers that are not equal to themselves.
bool sameBits(const std::vector<float>& a, const std::vector<float>& b) {
    return !a.empty() && a.size() == b.size() &&
           std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

using Counts = std::map<std::string, double>;

struct Session {
    bool interactive;
    std::shared_ptr<Scene> scene = makeScene();
    RenderSettings settings = small(interactive);
    std::unique_ptr<Renderer> renderer = makeRenderer("embree");
    std::shared_ptr<Film> film = std::make_shared<Film>();
    Counts counts;

    explicit Session(bool quick) : interactive(quick) { render(); }

    void render() {
        renderer->start(scene, "/camera", settings, film);
        renderer->wait();
        EXPECT_FALSE(renderer->progress().failed) << renderer->progress().error;
        counts = renderer->progress().statistics;
    }

    /// Renders what was edited. @returns what was built for it
    std::string rendered() {
        const Counts before = counts;
        render();
        std::string text;
        for (const char* name : {"surfacesBuilt", "surfacesTessellated", "groupsBuilt",
                                 "programsBuilt", "lightsBuilt"})
            text += (text.empty() ? "" : " ") + std::to_string(int(counts[name] - before.at(name)));
        auto fresh = makeRenderer("embree");
        auto other = std::make_shared<Film>();
        fresh->start(scene, "/camera", settings, other);
        fresh->wait();
        for (const char* aov : {"color", "alpha", "primId", "instanceId", "normal"})
            EXPECT_TRUE(sameBits(film->resolve(aov), other->resolve(aov)))
                << aov << " differs from that of a fresh renderer";
        return text;
    }

    template <class T> std::shared_ptr<T> copy(const std::string& path) {
        return std::make_shared<T>(static_cast<const T&>(*scene->snapshot()->geometry.at(path)));
    }
};

class Edits : public testing::TestWithParam<bool> {};

} // namespace

// The numbers are: surfaces built, of these tessellated, groups, programs, lights.

TEST_P(Edits, NothingOrTheCameraOrSettings) {
    Session session(GetParam());
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.scene->edit().set(makeCamera(9.01f));
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.settings.samples = 3;
    session.settings.maxDepth = 2;
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
}

TEST_P(Edits, ACameraThatComesNearRefinesOnlyWhatIsSubdivided) {
    Session session(GetParam());
    session.scene->edit().set(makeCamera(4));
    EXPECT_EQ(session.rendered(), "1 1 1 0 0");
}

TEST_P(Edits, ATransformMovesOnePrim) {
    Session session(GetParam());
    auto cube = session.copy<Mesh>("/cube");
    cube->transform = translate(-2, 0.5f, 0.5f);
    put<Geometry>(*session.scene, cube);
    EXPECT_EQ(session.rendered(), session.interactive ? "1 0 1 0 0" : "1 1 1 0 0");
}

TEST_P(Edits, APrimOfAPrototypeChangesWhatHoldsIt) {
    Session session(GetParam());
    auto leaf = session.copy<Mesh>("/leaf");
    leaf->transform = glm::scale(mat4(1.0f), vec3(0.5f));
    put<Geometry>(*session.scene, leaf);
    // A, B and the world, but not C
    EXPECT_EQ(session.rendered(), session.interactive ? "1 0 3 0 0" : "1 1 3 0 0");
}

TEST_P(Edits, AnInstancerMoves) {
    Session session(GetParam());
    put<Instancer>(*session.scene, makeInstancer("/i1", "B", "A", 0.9f));
    EXPECT_EQ(session.rendered(), "0 0 2 0 0");
}

TEST_P(Edits, PointsOfOnePrim) {
    Session session(GetParam());
    auto cube = session.copy<Mesh>("/cube");
    cube->points.values[0][0] = vec3(-2, -2, -2);
    put<Geometry>(*session.scene, cube);
    EXPECT_EQ(session.rendered(), "1 1 1 0 0");
}

TEST_P(Edits, AnotherMaterialOrIdOrVisibilityKeepsTheShape) {
    Session session(GetParam());
    auto cube = session.copy<Mesh>("/cube");
    cube->material = "";
    cube->id = 7;
    put<Geometry>(*session.scene, cube);
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    cube = session.copy<Mesh>("/cube");
    cube->visibility.camera = false;
    put<Geometry>(*session.scene, cube);
    EXPECT_EQ(session.rendered(), "0 0 1 0 0");
}

TEST_P(Edits, AMaterialCompilesOneProgram) {
    Session session(GetParam());
    session.scene->edit().set(makeMaterial("/red", 0.1f, 0.0f));
    EXPECT_EQ(session.rendered(), "0 0 0 1 0");
}

TEST_P(Edits, AMaterialThatGlowsChangesTheLights) {
    Session session(GetParam());
    session.scene->edit().set(makeMaterial("/glow", 0.1f, 2.0f));
    EXPECT_EQ(session.rendered(), "0 0 0 1 1");
    session.scene->edit().set(makeMaterial("/red", 0.1f, 2.0f));
    EXPECT_EQ(session.rendered(), "0 0 0 1 1");
    session.scene->edit().set(makeMaterial("/red", 0.1f, 0.0f));
    EXPECT_EQ(session.rendered(), "0 0 0 1 1");
}

TEST_P(Edits, WhatGlowsMoves) {
    Session session(GetParam());
    auto lamp = session.copy<Mesh>("/lamp");
    lamp->transform = translate(0, 2, 0) * glm::scale(mat4(1.0f), vec3(0.3f));
    put<Geometry>(*session.scene, lamp);
    EXPECT_EQ(session.rendered(), session.interactive ? "1 0 1 0 1" : "1 1 1 0 1");
}

TEST_P(Edits, ALightChangesOnlyLights) {
    Session session(GetParam());
    auto light = std::make_shared<Light>();
    light->path = "/key";
    light->transform = translate(0, 5, 5);
    light->intensity = 30;
    light->lightLink = "bright";
    put<Light>(*session.scene, light);
    EXPECT_EQ(session.rendered(), "0 0 0 0 1");
    // A prim joins the collection, whose number lights know.
    auto cube = session.copy<Mesh>("/cube");
    cube->categories = {"bright"};
    put<Geometry>(*session.scene, cube);
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.scene->edit().remove("/key");
    EXPECT_EQ(session.rendered(), "0 0 0 0 1");
}

TEST_P(Edits, PrimsComeAndGo) {
    Session session(GetParam());
    put<Geometry>(*session.scene, makeCube("/added", translate(0, -1.5f, 1)));
    EXPECT_EQ(session.rendered(), "1 1 1 0 0");
    session.scene->edit().remove("/cube");
    EXPECT_EQ(session.rendered(), "0 0 1 0 0");
    session.scene->edit().remove("/i1");
    EXPECT_EQ(session.rendered(), "0 0 2 0 0");
    put<Instancer>(*session.scene, makeInstancer("/i1", "B", "C", 0.9f));
    EXPECT_EQ(session.rendered(), "0 0 2 0 0");
    session.settings.interactive = !session.settings.interactive;
    session.rendered();
}

TEST_P(Edits, AVolumeStopsBeingDrawn) {
    Session session(GetParam());
    session.settings.renderTags = {"geometry"};
    session.rendered();
    const std::vector<float> clear = session.film->resolve("color");
    auto grid = std::make_shared<FieldGrid>(
        ivec3(0), ivec3(1), 1, translate(-1.5f, -0.5f, 1.0f) * glm::scale(mat4(1.0f), vec3(0.4f)));
    grid->setBrick(ivec3(0), std::vector<float>(FieldGrid::voxels, 1.0f));
    auto fog = std::make_shared<Volume>();
    fog->path = "/fog";
    fog->fields.push_back({"density", "", "", std::move(grid)});
    const auto draw = [&](std::shared_ptr<Geometry> prim) {
        put<Geometry>(*session.scene, prim);
        session.rendered(); // as a fresh renderer does
        return session.film->resolve("color");
    };
    EXPECT_FALSE(sameBits(draw(fog), clear));
    auto guide = std::make_shared<Volume>(*fog);
    guide->renderTag = "guide";
    EXPECT_TRUE(sameBits(draw(guide), clear));
    EXPECT_FALSE(sameBits(draw(fog), clear));
    auto mesh = makeCube("/fog", mat4(1.0f)); // what is not drawn has been a volume
    mesh->renderTag = "guide";
    EXPECT_TRUE(sameBits(draw(mesh), clear));
}

TEST_P(Edits, LookAtWhatTheyTouchHoweverManyPrimsThereAre) {
    for (const int count : {20, 200}) {
        Session session(GetParam());
        {
            SceneEdit edit = session.scene->edit();
            for (int i = 0; i < count; ++i)
                edit.set(std::shared_ptr<const Geometry>(
                    makeCube("/many/" + std::to_string(i), translate(float(i), -5, -9))));
        }
        session.rendered();
        const auto looked = [&] {
            const double before = session.counts["primsLookedAt"];
            session.rendered();
            return int(session.counts["primsLookedAt"] - before);
        };
        EXPECT_EQ(looked(), 0);
        session.scene->edit().set(makeMaterial("/red", 0.1f, 0.0f));
        EXPECT_EQ(looked(), 1) << "the prim with the material";
        auto cube = session.copy<Mesh>("/cube");
        cube->transform = translate(-2, 0.5f, 0.5f);
        cube->visibility.shadow = false;
        put<Geometry>(*session.scene, cube);
        EXPECT_EQ(looked(), 1);
        auto leaf = session.copy<Mesh>("/leaf");
        leaf->transform = glm::scale(mat4(1.0f), vec3(0.5f));
        put<Geometry>(*session.scene, leaf);
        EXPECT_EQ(looked(), 1) << "and no member of the groups around it";
        session.scene->edit().set(makeMaterial("/glow", 0.1f, 2.0f));
        EXPECT_EQ(looked(), 2) << "the lamp, as a prim and as a light";
        auto light = std::make_shared<Light>();
        light->path = "/key";
        put<Light>(*session.scene, light);
        EXPECT_EQ(looked(), 0);
        session.scene->edit().set(makeCamera(8.9f));
        EXPECT_GT(looked(), count) << "all may look larger";
        put<Geometry>(*session.scene, makeCube("/added", translate(0, -1.5f, 1)));
        EXPECT_GT(looked(), count) << "others may have other ids";
    }
}

TEST_P(Edits, AStoppedBuildIsTakenUpAgain) {
    Session session(GetParam());
    for (int i = 0; i < 30; ++i) {
        auto cube = session.copy<Mesh>("/cube");
        cube->transform = translate(-2, 0.02f * float(i), 0);
        put<Geometry>(*session.scene, cube);
        auto leaf = session.copy<Mesh>("/leaf");
        leaf->transform = glm::scale(mat4(1.0f), vec3(0.3f + 0.01f * float(i)));
        put<Geometry>(*session.scene, leaf);
        session.renderer->start(session.scene, "/camera", session.settings, session.film);
        std::this_thread::sleep_for(std::chrono::microseconds(50 * i));
        session.renderer->stop();
    }
    session.rendered();
    for (const Diagnostic& warning : session.scene->diagnostics().all())
        ADD_FAILURE() << warning.prim << ": " << warning.message;
}

INSTANTIATE_TEST_SUITE_P(, Edits, testing::Bool(), [](const auto& info) {
    return std::string(info.param ? "interactive" : "final");
});
