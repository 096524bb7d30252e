// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/tests/prims.h"

#include "base/tests/testTools.h"

#include <atomic>
#include <thread>

using namespace patina;

namespace {

constexpr int threadCount = 4, primsOfThread = 100, rounds = 8;

SdfPath pathOf(const char* kind, int number) {
    return SdfPath("/" + std::string(kind) + std::to_string(number));
}

/// A prim's changes to the shared state while it syncs. Prims change places with every round.
void syncPrim(HdPatinaRenderParam& param, int number, int round) {
    const SdfPath path = pathOf("prim", number), instancer = pathOf("instancer", number % 5);
    auto camera = makePrim<Camera>(path.GetString());
    camera->focalLength = float(round);
    param.set<Camera>(camera);

    auto data = std::make_shared<HdPatinaInstanceData>();
    data->transforms.resize(3);
    const VtIntArray indices = round % 2 == 0 ? VtIntArray{0, 1, 2} : VtIntArray{number % 3};
    param.instances().place(path, instancer, indices);
    param.instances().setInstancer(instancer, "", data);
    if (number % 7 == round) param.instances().leave(path);
    param.warn(path, "input", messages::notFinite);
    param.widenShutter(-0.25 * number, 0.25 * round);
    EXPECT_LE(param.shutter()[0], param.shutter()[1]);
}

} // namespace

/// Hosts sync prims on many threads, while renderers take snapshots. ThreadSanitizer sees these
/// threads, not those of hosts.
TEST(HydraRenderParam, PrimsSyncSideBySide) {
    HdPatinaRenderParam param;
    std::atomic<bool> done{false};
    std::thread renderer([&] {
        uint64_t last = 0;
        while (!done) {
            const auto state = param.scene()->snapshot();
            EXPECT_GE(state->version, last);
            last = state->version;
            for (const auto& camera : state->cameras) // one edit holds one round
                EXPECT_EQ(camera.second->focalLength, state->cameras.begin()->second->focalLength);
        }
    });
    for (int round = 0; round < rounds; ++round) {
        onThreads(threadCount, [&](int thread) {
            for (int i = 0; i < primsOfThread; ++i)
                syncPrim(param, i * threadCount + thread, round);
        });
        EXPECT_TRUE(param.commit());
    }
    done = true;
    renderer.join();

    const auto state = param.scene()->snapshot();
    EXPECT_EQ(state->version, uint64_t(rounds));
    EXPECT_EQ(state->cameras.size(), size_t(threadCount * primsOfThread));
    ASSERT_EQ(state->instancers.size(), 5u);
    for (const auto& instancer : state->instancers) { // the last round places at one index each
        EXPECT_EQ(instancer.second->prototypes.size(), 3u);
        EXPECT_EQ(instancer.second->transforms.size(), 3u);
    }
    EXPECT_EQ(param.scene()->diagnostics().count(), threadCount * primsOfThread);
    EXPECT_EQ(param.shutter(), GfVec2f(-0.25f * (threadCount * primsOfThread - 1), 1.75f));
}
