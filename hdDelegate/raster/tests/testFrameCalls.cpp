// SPDX-License-Identifier: Apache-2.0
// What the processor asks of the driver for a frame after a camera move, in calls and in bytes.

#include "hdDelegate/raster/gl/glFunctions.h"
#include "hdDelegate/raster/rasterRenderer.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"
#include "materialNetwork/tests/materialFixture.h"

#include <algorithm>
#include <cstdlib>
#include <atomic>

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
    const auto scene = sceneOf(makePrim<Light>("/lamp", translate(0, 0, 10)));
    SceneEdit edit = scene->edit();
    for (int i = 0; i < materials; ++i)
        edit.set(makeMaterial(
            "/material" + std::to_string(i),
            {makeNode("surface", "UsdPreviewSurface",
                      {{"roughness", number(0.1f + 0.8f * float(i) / float(materials))}})}));
    for (int i = 0; i < prims; ++i) {
        auto mesh = makeQuad("/mesh" + std::to_string(i), "",
                             vec2(float(i % 8) - 3.5f, float(i / 8) - 3.5f), 0.4f);
        mesh->material = "/material" + std::to_string(i % materials);
        edit.set(mesh);
    }
    return scene;
}

/// Calls of one frame, after some of them.
std::map<std::string, long> frame(int prims, int materials, std::string& error) {
    const auto renderer = makeRasterRenderer(error);
    if (!renderer) return {};
    static const bool counted = (countCalls(), true);
    (void)counted;
    const auto film = std::make_shared<Film>();
    const auto scene = makeScene(prims, materials);
    RenderSettings settings = imageOf(64, 64, 1);
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
        scene->edit().set(makePrim<Camera>(
            "/camera", translate(0.01f * float(i), 0, 30))); // all squares are in view
        for (auto& item : calls())
            item.second = 0;
        rendered(*renderer, scene, settings, film);
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
