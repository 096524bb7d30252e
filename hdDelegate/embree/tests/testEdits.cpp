// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/tests/meshFixtures.h"
#include "hdDelegate/image/fieldGrid.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"
#include "base/tests/testTools.h"
#include "materialNetwork/tests/materialFixture.h"

#include <chrono>

using namespace patina;

namespace {

std::shared_ptr<MaterialPrim> paint(const std::string& path, float red, float glow) {
    Inputs inputs = {{"diffuseColor", color(red, 0.5f, 0.2f)}};
    if (glow > 0.0f) inputs["emissiveColor"] = color(glow, glow, 1.0f);
    return makeMaterial(path, {makeNode("surface", "UsdPreviewSurface", inputs)});
}

std::shared_ptr<Mesh> makeCube(const std::string& path, const mat4& transform,
                               const std::string& group = "") {
    auto mesh = std::make_shared<Mesh>(cubeMesh());
    mesh->path = path;
    mesh->group = group;
    mesh->transform = transform;
    return mesh;
}

std::shared_ptr<Camera> makeCamera(float z) {
    return makePrim<Camera>("/camera", translate(0, 0.5f, z));
}

std::shared_ptr<Instancer> row(const std::string& path, const std::string& group,
                               const std::string& prototype, float step) {
    return makeInstancer(
        path, group, prototype,
        {translate(-step, 0, -2), translate(0, 0.3f, -2), translate(step, 0.6f, -2)});
}

/// Everything at once: prims in the world, two levels of instances, lights and something that
/// glows.
std::shared_ptr<Scene> makeScene() {
    auto cube = makeCube("/cube", translate(-2, 0, 0)),
         smooth = makeCube("/smooth", translate(2, 0, 0)),
         lamp = makeCube("/lamp", translate(0, 3, 0) * scaled(0.3f));
    cube->material = "/red";
    smooth->scheme = SubdivisionScheme::CatmullClark;
    lamp->material = "/glow";
    return sceneOf(cube, smooth, lamp, makeCube("/leaf", scaled(0.4f), "A"),
                   makeCube("/other", scaled(0.2f), "C"), row("/i1", "B", "A", 1.0f),
                   row("/i2", "", "B", 3.0f), row("/i3", "", "C", 2.0f), paint("/red", 0.8f, 0.0f),
                   paint("/glow", 0.0f, 5.0f), makeLight("/dome", LightType::Dome), makeCamera(9));
}

RenderSettings small(bool interactive) {
    RenderSettings settings = imageOf(48, 32, 2);
    settings.interactive = interactive;
    settings.aovs = {"primId", "instanceId", "normal"};
    return settings;
}

struct Session {
    bool interactive;
    std::shared_ptr<Scene> scene = makeScene();
    RenderSettings settings = small(interactive);
    std::unique_ptr<Renderer> renderer = makeRenderer("embree");
    std::shared_ptr<Film> film = std::make_shared<Film>();
    std::map<std::string, double> counts;

    explicit Session(bool quick) : interactive(quick) { render(); }

    void render() {
        patina::rendered(*renderer, scene, settings, film);
        EXPECT_FALSE(renderer->progress().failed) << renderer->progress().error;
        counts = renderer->progress().statistics;
    }
    template <class Prim> void set(const std::shared_ptr<Prim>& prim) { scene->edit().set(prim); }
    /// Sets a mesh that is there with a change.
    template <class Change> void change(const std::string& path, Change change) {
        auto mesh =
            std::make_shared<Mesh>(static_cast<const Mesh&>(*scene->snapshot()->geometry.at(path)));
        change(*mesh);
        set(mesh);
    }
    void move(const std::string& path, const mat4& transform) {
        change(path, [&](Mesh& mesh) { mesh.transform = transform; });
    }

    /// Renders what was edited. @returns what was built for it
    std::string rendered() {
        const auto before = counts;
        render();
        std::string text;
        for (const char* name : {"surfacesBuilt", "surfacesTessellated", "groupsBuilt",
                                 "programsBuilt", "lightsBuilt"})
            text += (text.empty() ? "" : " ") + std::to_string(int(counts[name] - before.at(name)));
        const auto other = patina::rendered(*makeRenderer("embree"), scene, settings);
        for (const char* aov : {"color", "alpha", "primId", "instanceId", "normal"}) {
            EXPECT_FALSE(film->resolve(aov).empty()) << aov;
            EXPECT_TRUE(sameBits(film->resolve(aov), other->resolve(aov)))
                << aov << " differs from that of a fresh renderer";
        }
        return text;
    }
};

class Edits : public testing::TestWithParam<bool> {};

} // namespace

// The numbers are: surfaces built, of these tessellated, groups, programs, lights.

TEST_P(Edits, NothingOrTheCameraOrSettings) {
    Session session(GetParam());
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.set(makeCamera(9.01f));
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.settings.samples = 3;
    session.settings.maxDepth = 2;
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
}

TEST_P(Edits, RebuildWhatTheyTouch) {
    const struct {
        const char* name;
        void (*edit)(Session&);
        const char *final, *interactive;
    } cases[] = {
        {"a camera that comes near refines only what is subdivided",
         [](Session& s) { s.set(makeCamera(4)); }, "1 1 1 0 0", "1 1 1 0 0"},
        {"a transform moves one prim",
         [](Session& s) { s.move("/cube", translate(-2, 0.5f, 0.5f)); }, "1 1 1 0 0", "1 0 1 0 0"},
        {"a prim of a prototype changes what holds it: A, B and the world, but not C",
         [](Session& s) { s.move("/leaf", scaled(0.5f)); }, "1 1 3 0 0", "1 0 3 0 0"},
        {"an instancer moves", [](Session& s) { s.set(row("/i1", "B", "A", 0.9f)); }, "0 0 2 0 0",
         "0 0 2 0 0"},
        {"points of one prim",
         [](Session& s) { s.change("/cube", [](Mesh& m) { m.points.values[0][0] = vec3(-2); }); },
         "1 1 1 0 0", "1 1 1 0 0"},
        {"a material compiles one program", [](Session& s) { s.set(paint("/red", 0.1f, 0.0f)); },
         "0 0 0 1 0", "0 0 0 1 0"},
        {"what glows moves", [](Session& s) { s.move("/lamp", translate(0, 2, 0) * scaled(0.3f)); },
         "1 1 1 0 1", "1 0 1 0 1"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.name);
        Session session(GetParam());
        c.edit(session);
        EXPECT_EQ(session.rendered(), session.interactive ? c.interactive : c.final);
    }
}

TEST_P(Edits, AnotherMaterialOrIdOrVisibilityKeepsTheShape) {
    Session session(GetParam());
    session.change("/cube", [](Mesh& cube) {
        cube.material = "";
        cube.id = 7;
    });
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.change("/cube", [](Mesh& cube) { cube.visibility.camera = false; });
    EXPECT_EQ(session.rendered(), "0 0 1 0 0");
}

TEST_P(Edits, AMaterialThatGlowsChangesTheLights) {
    Session session(GetParam());
    for (const auto& [path, glow] : {std::pair("/glow", 2.0f), {"/red", 2.0f}, {"/red", 0.0f}}) {
        session.set(paint(path, 0.1f, glow));
        EXPECT_EQ(session.rendered(), "0 0 0 1 1") << path << " " << glow;
    }
}

TEST_P(Edits, ALightChangesOnlyLights) {
    Session session(GetParam());
    auto light = makePrim<Light>("/key", translate(0, 5, 5));
    light->intensity = 30;
    light->lightLink = "bright";
    session.set(light);
    EXPECT_EQ(session.rendered(), "0 0 0 0 1");
    // A prim joins the collection, whose number lights know.
    session.change("/cube", [](Mesh& cube) { cube.categories = {"bright"}; });
    EXPECT_EQ(session.rendered(), "0 0 0 0 0");
    session.scene->edit().remove("/key");
    EXPECT_EQ(session.rendered(), "0 0 0 0 1");
}

TEST_P(Edits, PrimsComeAndGo) {
    Session session(GetParam());
    session.set(makeCube("/added", translate(0, -1.5f, 1)));
    EXPECT_EQ(session.rendered(), "1 1 1 0 0");
    session.scene->edit().remove("/cube");
    EXPECT_EQ(session.rendered(), "0 0 1 0 0");
    session.scene->edit().remove("/i1");
    EXPECT_EQ(session.rendered(), "0 0 2 0 0");
    session.set(row("/i1", "B", "C", 0.9f));
    EXPECT_EQ(session.rendered(), "0 0 2 0 0");
    session.settings.interactive = !session.settings.interactive;
    session.rendered();
    session.settings.compactGeometry = true;
    session.rendered();
    session.move("/leaf", scaled(0.5f));
    session.rendered();
}

TEST_P(Edits, AVolumeStopsBeingDrawn) {
    Session session(GetParam());
    session.settings.renderTags = {"geometry"};
    session.rendered();
    const std::vector<float> clear = session.film->resolve("color");
    auto grid = std::make_shared<FieldGrid>(ivec3(0), ivec3(1), 1,
                                            translate(-1.5f, -0.5f, 1.0f) * scaled(0.4f));
    grid->setBrick(ivec3(0), std::vector<float>(FieldGrid::voxels, 1.0f));
    auto fog = makePrim<Volume>("/fog");
    fog->fields.push_back({"density", "", "", std::move(grid)});
    const auto draw = [&](std::shared_ptr<Geometry> prim) {
        session.set(prim);
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
                edit.set(makeCube("/many/" + std::to_string(i), translate(float(i), -5, -9)));
        }
        session.rendered();
        const auto looked = [&] {
            const double before = session.counts["primsLookedAt"];
            session.rendered();
            return int(session.counts["primsLookedAt"] - before);
        };
        EXPECT_EQ(looked(), 0);
        session.set(paint("/red", 0.1f, 0.0f));
        EXPECT_EQ(looked(), 1) << "the prim with the material";
        session.change("/cube", [](Mesh& cube) {
            cube.transform = translate(-2, 0.5f, 0.5f);
            cube.visibility.shadow = false;
        });
        EXPECT_EQ(looked(), 1);
        session.move("/leaf", scaled(0.5f));
        EXPECT_EQ(looked(), 1) << "and no member of the groups around it";
        session.set(paint("/glow", 0.1f, 2.0f));
        EXPECT_EQ(looked(), 2) << "the lamp, as a prim and as a light";
        session.set(makePrim<Light>("/key"));
        EXPECT_EQ(looked(), 0);
        session.set(makeCamera(8.9f));
        EXPECT_GT(looked(), count) << "all may look larger";
        session.set(makeCube("/added", translate(0, -1.5f, 1)));
        EXPECT_GT(looked(), count) << "others may have other ids";
    }
}

TEST_P(Edits, AStoppedBuildIsTakenUpAgain) {
    Session session(GetParam());
    for (int i = 0; i < 30; ++i) {
        session.move("/cube", translate(-2, 0.02f * float(i), 0));
        session.move("/leaf", scaled(0.3f + 0.01f * float(i)));
        session.renderer->start(session.scene, "/camera", session.settings, session.film);
        std::this_thread::sleep_for(std::chrono::microseconds(50 * i));
        session.renderer->stop();
    }
    session.rendered();
    expectSilence(session.scene->diagnostics());
}

INSTANTIATE_TEST_SUITE_P(, Edits, testing::Bool(), [](const auto& info) {
    return std::string(info.param ? "interactive" : "final");
});
