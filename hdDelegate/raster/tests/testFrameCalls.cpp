// SPDX-License-Identifier: Apache-2.0
// What the processor asks of the driver for a frame after a camera move, in calls and in bytes.

#include "hdDelegate/raster/gl/glFunctions.h"
#include "hdDelegate/raster/rasterRenderer.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

#include <algorithm>
#include <cstdlib>
#include <atomic>
#include <map>
#include <string>
#include <vector>

using namespace patina;

namespace {

std::map<std::string, std::atomic<long>>& calls() {
    static std::map<std::string, std::atomic<long>>& all =
        *new std::map<std::string, std::atomic<long>>;
    return all;
}

template <auto Member, typename Function> struct Counting;

template <auto Member, typename Result, typename... Arguments>
struct Counting<Member, Result(APIENTRY*)(Arguments...)> {
    static inline Result(APIENTRY* driver)(Arguments...) = nullptr;
    static inline std::atomic<long>* count = nullptr;

    static Result APIENTRY call(Arguments... arguments) {
        ++*count;
        return driver(arguments...);
    }
};

/// Has all functions of `gl` count their calls. Once, with them loaded.
void countCalls(){
#define PATINA_GL_COUNT(name, NAME)                                                                \
    {                                                                                              \
        using Counted = Counting<&GlFunctions::name, PFNGL##NAME##PROC>;                           \
        Counted::driver = gl.name;                                                                 \
        Counted::count = &calls()[#name];                                                          \
        gl.name = Counted::call;                                                                   \
    }
    PATINA_GL_FUNCTIONS(PATINA_GL_COUNT)
#undef PATINA_GL_COUNT
}

/// Squares in rows, each a prim of its own, in a number of materials, under a lamp.
std::shared_ptr<Scene> makeScene(int prims, int materials) {
    auto scene = std::make_shared<Scene>();
    SceneEdit edit = scene->edit();
    for (int i = 0; i < materials; ++i) {
        auto material = std::make_shared<MaterialPrim>();
        material->path = material->network.path = "/material" + std::to_string(i);
        NetworkNode surface;
        surface.path = material->path + "/surface";
        surface.id = "UsdPreviewSurface";
        surface.inputs["roughness"] = Value::makeFloat(0.1f + 0.8f * float(i) / float(materials));
        material->network.nodes = {surface};
        material->network.terminals["surface"] = {surface.path, ""};
        edit.set(std::shared_ptr<const MaterialPrim>(material));
    }
    for (int i = 0; i < prims; ++i) {
        auto mesh = std::make_shared<Mesh>();
        mesh->path = "/mesh" + std::to_string(i);
        mesh->material = "/material" + std::to_string(i % materials);
        const float x = float(i % 8) - 3.5f, y = float(i / 8) - 3.5f;
        mesh->points = std::vector<vec3>{vec3(x - 0.4f, y - 0.4f, 0), vec3(x + 0.4f, y - 0.4f, 0),
                                         vec3(x + 0.4f, y + 0.4f, 0), vec3(x - 0.4f, y + 0.4f, 0)};
        mesh->faceVertexCounts = {4};
        mesh->faceVertexIndices = {0, 1, 2, 3};
        edit.set(std::shared_ptr<const Geometry>(mesh));
    }
    auto lamp = std::make_shared<Light>();
    lamp->path = "/lamp";
    mat4 above(1.0f);
    above[3] = vec4(0, 0, 10, 1);
    lamp->transform = above;
    edit.set(std::shared_ptr<const Light>(lamp));
    return scene;
}

void setCamera(Scene& scene, float x) {
    SceneEdit edit = scene.edit();
    auto camera = std::make_shared<Camera>();
    camera->path = "/camera";
    mat4 place(1.0f);
    place[3] = vec4(x, 0, 30, 1); // all squares are in view
    camera->transform = place;
    edit.set(std::shared_ptr<const Camera>(camera));
}

/// Calls of one frame, after some of them.
std::map<std::string, long> frame(int prims, int materials, std::string& error) {
    const auto renderer = makeRasterRenderer(error);
    if (!renderer) return {};
    static const bool counted = (countCalls(), true);
    (void)counted;
    const auto film = std::make_shared<Film>();
    const auto scene = makeScene(prims, materials);
    RenderSettings settings;
    settings.width = settings.height = 64;
    settings.samples = 1;
    settings.interactive = true;
    std::vector<uint8_t> color(64 * 64 * 8), depth(64 * 64 * 4);
    renderer->letImagesStay(true);
    renderer->setListener([&](const Film& f, const RenderProgress& p) {
        if (p.failed) error = p.error;
        if (!f.source()) return; // of what is ready
        PixelForm form;
        form.bottomFirst = true;
        form.components = 1;
        EXPECT_TRUE(f.source()->read(AovId::deviceDepth, form, depth.data()));
        form.type = PixelForm::Type::Half;
        form.components = 4;
        EXPECT_TRUE(f.source()->read(AovId::color, form, color.data()));
    });
    std::map<std::string, long> found;
    for (int i = 0; i < 4; ++i) {
        setCamera(*scene, 0.01f * float(i));
        for (auto& item : calls())
            item.second = 0;
        renderer->start(scene, "/camera", settings, film);
        renderer->wait();
    }
    EXPECT_TRUE(std::any_of(color.begin(), color.end(), [](uint8_t v) { return v != 0; }));
    for (const auto& item : calls())
        if (item.second > 0) found[item.first] = item.second;
    return found;
}

long of(const std::map<std::string, long>& calls, const char* name) {
    const auto found = calls.find(name);
    return found == calls.end() ? 0 : found->second;
}

long sum(const std::map<std::string, long>& calls) {
    long all = 0;
    for (const auto& item : calls)
        all += item.second;
    // Of HeldFences, where the driver needs them.
    return all - of(calls, "FenceSync") - of(calls, "DeleteSync");
}

} // namespace

TEST(FrameCalls, AfterAMoveFollowWhatIsInView) {
    PATINA_NEED_CONTEXT();
    std::string error;
    const auto few = frame(8, 1, error), many = frame(64, 1, error), varied = frame(64, 8, error);
    ASSERT_EQ(error, "");
    for (const char* name : {"Finish", "Flush", "ReadPixels", "GetIntegerv", "GetInteger64v",
                             "GetString", "GetUniformLocation", "CheckNamedFramebufferStatus",
                             "CreateTextures", "CreateFramebuffers", "CreateProgram"})
        EXPECT_EQ(of(many, name), 0) << name;
    EXPECT_EQ(of(many, "NamedFramebufferTextureLayer"), 0) << "shadow maps stay as they are";
    EXPECT_EQ(of(many, "GetTextureSubImage"), 2) << "colour and depth";
    // Ids, depth and colour: what has one material is one call, however many prims it has.
    const char* const draw = "MultiDrawElementsIndirect";
    EXPECT_EQ(of(few, draw), 3);
    EXPECT_EQ(of(many, draw), 3);
    EXPECT_EQ(sum(many), sum(few));
    // Eight materials, in another order than the prims: a block of values, a call and the number of
    // its first draw for each, in two passes.
    EXPECT_EQ(of(varied, draw), 1 + 2 * 8);
    EXPECT_LE(sum(varied) - sum(many), 3 * 2 * 8);
    // Where shaders are not told their draw, each has a call of its own in passes that ask.
    setenv("PATINA_GL_FAULT", "singleDraws:1", 1);
    const auto single = frame(64, 1, error);
    unsetenv("PATINA_GL_FAULT");
    EXPECT_EQ(of(single, draw), 1 + 2 * 64);
    RecordProperty("calls", std::to_string(sum(many)));
}
