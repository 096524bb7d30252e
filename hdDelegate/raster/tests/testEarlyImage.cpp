// SPDX-License-Identifier: Apache-2.0
// Images while programs are compiled: something simple stands in for what is not ready, and nothing
// of that reaches the final image.

#include "hdDelegate/raster/gl/programCompiler.h"
#include "hdDelegate/raster/rasterRenderer.h"
#include "hdDelegate/raster/tests/rasterFixture.h"
#include "hdDelegate/renderer/tests/rendering.h"
#include "hdDelegate/scene/tests/prims.h"
#include "materialNetwork/tests/materialFixture.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <numeric>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

using namespace patina;

namespace {

/// Makes every material take so long, without the files of earlier runs.
struct SlowPrograms {
    explicit SlowPrograms(const std::string& milliseconds, const std::string& more = "") {
        setenv("PATINA_GL_FAULT", ("compiling:" + milliseconds + more).c_str(), 1);
        setenv("PATINA_CACHE", "", 1);
    }
    ~SlowPrograms() {
        unsetenv("PATINA_GL_FAULT");
        unsetenv("PATINA_CACHE");
    }
};

/// Three squares beside each other, without lights. They glow red, green and blue; or they are
/// metals of these colours.
std::shared_ptr<Scene> makeScene(bool metals = false) {
    const auto scene = sceneOf(makePrim<Camera>("/camera", translate(0, 0, 8)));
    for (int i = 0; i < 3; ++i) {
        const std::string name = std::to_string(i), material = "/material" + name;
        // Each has a text of its own, which is compiled quickly.
        vec3 c(0.0f);
        c[i] = metals ? 0.8f : 2.0f;
        const Value shade = color(c.x, c.y, c.z);
        std::vector<NetworkNode> nodes = {
            makeNode("surface", "ND_surface", {}, {{"edf", {i == 2 ? "twice" : "glow", ""}}}),
            makeNode("glow", i == 0 ? "ND_uniform_edf" : "ND_conical_edf", {{"color", shade}}),
            makeNode("twice", "ND_multiply_edfF", {{"in2", number(2.0f)}},
                     {{"in1", {"glow", ""}}})};
        if (metals)
            nodes = {makeNode("surface", "UsdPreviewSurface",
                              {{"diffuseColor", shade},
                               {"metallic", number(1.0f)},
                               {"clearcoat", number(i == 1 ? 0.1f : 0.0f)}})};
        auto mesh = makeQuad("/mesh" + name, "", vec2(1.1f * float(i - 1), 0), 0.5f);
        mesh->material = material;
        setPrims(*scene, makeMaterial(material, nodes), mesh);
    }
    if (metals) {
        auto sky = makeLight("/sky", LightType::Dome);
        sky->cameraVisible = false;
        scene->edit().set(sky);
    }
    return scene;
}

struct Shown {
    std::vector<std::vector<float>> images; ///< while it ran, and the last
    std::vector<RenderProgress> reported;
    std::vector<float> last;
    std::string error;
};

Shown render(bool interactive, int threads, bool metals = false) {
    Shown shown;
    const auto renderer = makeRasterRenderer(shown.error);
    if (!renderer) return shown;
    RenderSettings settings = imageOf(24, 12, 2);
    settings.threads = threads;
    settings.interactive = interactive;
    renderer->setListener([&](const Film& f, const RenderProgress& p) {
        shown.images.push_back(f.resolve("color"));
        shown.reported.push_back(p);
    });
    const auto film = rendered(*renderer, makeScene(metals), settings);
    shown.error = renderer->progress().error;
    shown.last = film->resolve("color");
    return shown;
}

float sum(const std::vector<float>& image) {
    return std::accumulate(image.begin(), image.end(), 0.0f);
}

float brightest(const std::vector<float>& image) {
    return image.empty() ? 0.0f : *std::max_element(image.begin(), image.end());
}

} // namespace

TEST(EarlyImages, ShowWhatIsReadyAndLeaveNothingInTheLast) {
    PATINA_NEED_CONTEXT();
    const SlowPrograms slow("1500"); // longer than cached ones are waited for
    const Shown batch = render(false, 1);
    ASSERT_EQ(batch.error, "");
    ASSERT_GT(brightest(batch.last), 1.0f) << "nothing glows";
    for (const RenderProgress& p : batch.reported)
        EXPECT_EQ(p.statistics.at("materialsReady"), p.statistics.at("materialsWanted"))
            << "nobody looks on, so the first image has all materials";
    for (const int threads : {1, 3}) {
        const Shown shown = render(true, threads);
        ASSERT_EQ(shown.error, "");
        ASSERT_GT(shown.images.size(), 1u);
        const auto& first = shown.reported.front().statistics;
        EXPECT_LT(first.at("materialsReady"), first.at("materialsWanted")) << threads;
        // What stands in for a surface that glows is black.
        EXPECT_LT(sum(shown.images.front()), 0.9f * sum(batch.last)) << threads;
        EXPECT_FALSE(shown.reported.front().converged);
        EXPECT_TRUE(shown.reported.back().converged);
        EXPECT_EQ(shown.last, batch.last) << "the order of programs reached the image: " << threads;
    }
}

TEST(EarlyImages, HaveTheColorsOfTheirMaterials) {
    PATINA_NEED_CONTEXT();
    const SlowPrograms slow("1500");
    const Shown shown = render(true, 1, true);
    ASSERT_EQ(shown.error, "");
    ASSERT_GT(shown.images.size(), 1u);
    const auto& first = shown.reported.front().statistics;
    EXPECT_LT(first.at("materialsReady"), first.at("materialsWanted"));
    const auto colorOf = [](const std::vector<float>& image, int square) {
        vec3 sum(0.0f); // over a third of each row
        for (int y = 0; y < 12; ++y)
            for (int x = 8 * square; x < 8 * square + 8; ++x)
                for (int c = 0; c < 3; ++c)
                    sum[c] += image[size_t(3 * (y * 24 + x) + c)];
        return sum;
    };
    for (int i = 0; i < 3; ++i) {
        const vec3 early = colorOf(shown.images.front(), i), last = colorOf(shown.last, i);
        ASSERT_GT(last[i], 1.0f);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(early[c], last[c], 0.1f * last[i]) << "square " << i << " channel " << c;
    }
}

TEST(EarlyImages, ADriverThatDoesNotTakeTheStandInShowsDisplayColor) {
    PATINA_NEED_CONTEXT();
    const SlowPrograms slow("1500", ",material:/standIn");
    const Shown shown = render(true, 1, true);
    ASSERT_EQ(shown.error, "");
    ASSERT_GT(shown.images.size(), 1u);
    const auto& image = shown.images.front();
    float seen = 0.0f; // the second of two programs, which nothing has compiled yet
    for (size_t i = 0; i < image.size(); i += 3) {
        if (i / 3 % 24 < 9 || i / 3 % 24 > 14) continue;
        EXPECT_NEAR(image[i], image[i + 1], 1e-3f * image[i]) << "it is grey";
        seen += image[i];
    }
    EXPECT_GT(seen, 0.0f);
    EXPECT_GT(brightest(shown.last), 0.5f);
}

TEST(EarlyImages, AStoppedRenderDoesNotWaitForPrograms) {
    PATINA_NEED_CONTEXT();
    const SlowPrograms slow("300");
    std::string error;
    const auto renderer = makeRasterRenderer(error);
    ASSERT_TRUE(renderer) << error;
    RenderSettings settings = imageOf(8, 8);
    settings.threads = 2;
    const auto film = std::make_shared<Film>();
    for (int i = 0; i < 3; ++i) {
        renderer->start(makeScene(), "/camera", settings, film);
        std::this_thread::sleep_for(std::chrono::milliseconds(40 * i));
        renderer->stop();
        EXPECT_FALSE(renderer->isRunning());
    }
    renderer->start(makeScene(), "/camera", settings, film);
    renderer->wait();
    EXPECT_TRUE(renderer->progress().converged);
    EXPECT_GT(brightest(film->resolve("color")), 1.0f);
}

TEST(ProgramCompiler, ProgramsOfOtherThreadsRunHere) {
    PATINA_NEED_CONTEXT();
    std::vector<std::unique_ptr<GlProgram>> programs(6);
    std::vector<std::thread::id> where(6);
    std::string errors[6];
    std::atomic<int> done{0};
    {
        ProgramCompiler compiler(*context, 2);
        for (size_t i = 0; i < programs.size(); ++i)
            compiler.add([&, i] {
                const std::string text = "layout(local_size_x = 1) in;\n"
                                         "layout(std430, binding = 0) buffer R { float r[]; };\n"
                                         "void main() { r[0] = " +
                                         std::to_string(i) + ".0; }\n";
                programs[i] = GlProgram::make({{GL_COMPUTE_SHADER, "test", text}}, errors[i]);
                where[i] = std::this_thread::get_id();
                ++done;
            });
        EXPECT_TRUE(compiler.hasThreads());
        while (done < 6)
            compiler.wait(std::chrono::milliseconds(20)); // without help
        EXPECT_FALSE(compiler.help());
    }
    const GlBuffer result(16, nullptr);
    result.bindStorage(0);
    for (size_t i = 0; i < programs.size(); ++i) {
        ASSERT_TRUE(programs[i]) << errors[i];
        EXPECT_NE(where[i], std::this_thread::get_id());
        EXPECT_EQ(computed<float>(*programs[i], 1, result, 1)[0], float(i));
    }
}

/// Bytes that malloc has handed out; 0 where it does not tell.
double heapBytes() {
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 33)
    const struct mallinfo2 found = mallinfo2();
    return double(found.uordblks) + double(found.hblkhd);
#else
    return 0.0;
#endif
}

TEST(ProgramCompiler, ProgramsThatAreDeletedLeaveNothing) {
    PATINA_NEED_CONTEXT();
    const SlowPrograms uncached("0");
    ProgramCompiler compiler(*context, 1);
    std::string fragment = "layout(location = 0) out vec4 o;\nvoid main() {\n"
                           "vec4 x = gl_FragCoord * 0.01;\n";
    for (int i = 1; i <= 60; ++i)
        fragment += "x = vec4(sin(x.y * " + std::to_string(i) + ".0), cos(x.x), x.w, x.z);\n";
    fragment += "o = x;\n}\n";
    const auto make = [&] {
        std::unique_ptr<GlProgram> program;
        std::string error;
        std::atomic<bool> done{false};
        compiler.add([&] {
            program = GlProgram::make(
                {{GL_VERTEX_SHADER, "vertex", "void main() { gl_Position = vec4(gl_VertexID); }\n"},
                 {GL_FRAGMENT_SHADER, "fragment", fragment}},
                error);
            done = true;
        });
        while (!done)
            compiler.wait(std::chrono::milliseconds(20));
        EXPECT_TRUE(program) << error;
        return program;
    };
    make(); // whatever the driver keeps of a first one
    const double before = heapBytes();
    double some = 0.0;
    {
        std::vector<std::unique_ptr<GlProgram>> programs;
        for (int i = 0; i < 4; ++i)
            programs.push_back(make());
        some = heapBytes() - before;
    }
    if (!(some > 0.0)) GTEST_SKIP() << "this heap does not tell how much is in use";
    make();
    const double start = heapBytes();
    for (int i = 0; i < 32; ++i)
        make();
    EXPECT_LT(heapBytes() - start, some) << "32 that are gone take less than four that are there";
}

TEST(ProgramCompiler, WhoeverWaitsDoesTheWorkWhereThereAreNoThreads) {
    PATINA_NEED_CONTEXT();
    ProgramCompiler compiler(*context, 0);
    int count = 0;
    for (int i = 0; i < 3; ++i)
        compiler.add([&] { ++count; });
    EXPECT_FALSE(compiler.hasThreads());
    EXPECT_EQ(count, 0);
    while (compiler.help()) {
    }
    EXPECT_EQ(count, 3);
}
