// Random edits of a stage while it renders: after any number of them, scene and picture are those
// of a host that opens the stage as it is now.

#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/edits/edits.h"
#include "testenv/hydra/tests/comparing.h"

#include <chrono>
#include <cstdlib>
#include <thread>

using namespace patina;

namespace {

constexpr uint32_t seed = 20240817;

int editCount() {
    const char* text = std::getenv("PATINA_HYDRA_EDITS");
    return text ? std::atoi(text) : 400;
}

HostOptions optionsFor(bool sceneIndex) {
    HostOptions options;
    options.sceneIndex = sceneIndex;
    options.width = options.height = 24;
    options.camera = SdfPath("/World/cameras/main");
    options.settings[TfToken("samples")] = VtValue(2);
    options.settings[TfToken("seed")] = VtValue(7);
    return options;
}

class HydraEdits : public testing::TestWithParam<bool> {
protected:
    /// Both hosts show the same stage: as text (scene indices), and every bit of the picture.
    static void expectSame(Host& edited, const UsdStageRefPtr& stage, const std::string& after) {
        edited.setSize(24, 24);
        edited.setAovs({HostAov()});
        ASSERT_TRUE(edited.render(120.0)) << after;
        HostOptions options = edited.options();
        Host fresh(stage, options);
        ASSERT_TRUE(fresh.render(120.0)) << after;
        // UsdImagingDelegate names instancers after whichever instance it met first.
        if (options.sceneIndex) {
            const std::string difference = differences(sceneText(edited), sceneText(fresh));
            ASSERT_EQ(difference, "") << "edited and fresh scene differ after " << after;
        }
        ASSERT_EQ(differentPixels(edited.read("color"), fresh.read("color")), 0)
            << "after " << after;
    }
};

} // namespace

TEST_P(HydraEdits, EndLikeAFreshHost) {
    const UsdStageRefPtr stage = makeBaseStage();
    Host host(stage, optionsFor(GetParam()));
    RandomEdits edits(stage, host, seed);
    Random pace(seed + 1);
    const int count = editCount();
    // Differences are found near their cause, but most edits meet a render that goes on.
    const int between = std::max(count / 40, 10);
    std::string recent;
    for (int i = 1; i <= count; ++i) {
        recent += edits.apply() + " ";
        if (pace.chance(0.6f)) host.execute();
        if (pace.chance(0.1f))
            std::this_thread::sleep_for(std::chrono::microseconds(pace.index(3000)));
        if (i % between == 0 || i == count) {
            expectSame(host, stage, std::to_string(i) + " edits, the last of them " + recent);
            if (HasFatalFailure()) return;
            recent.clear();
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Inputs, HydraEdits, testing::Bool(),
                         [](const testing::TestParamInfo<bool>& info) {
                             return info.param ? "SceneIndex" : "Delegate";
                         });
