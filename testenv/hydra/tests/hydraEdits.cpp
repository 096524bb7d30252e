// SPDX-License-Identifier: Apache-2.0
// Random edits of a stage while it renders: after any number of them, scene and picture are those
// of a host that opens the stage as it is now. The environment may say which edits, how many and by
// which back end (PATINA_HYDRA_SEED, PATINA_HYDRA_EDITS, PATINA_HYDRA_BACKEND).

#include "hdDelegate/hydra/compat.h"
#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/edits/edits.h"
#include "testenv/hydra/tests/comparing.h"

#include <pxr/usd/usd/errors.h>

#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>

using namespace patina;

namespace {

constexpr double patience = 600.0; ///< seconds: a driver in software compiles for long

int number(const char* variable, int otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atoi(text) : otherwise;
}

HostOptions optionsFor(bool sceneIndex) {
    HostOptions options;
    options.sceneIndex = sceneIndex;
    options.width = options.height = 24;
    options.camera = SdfPath("/World/cameras/main");
    options.settings[TfToken("samples")] = VtValue(2);
    options.settings[TfToken("seed")] = VtValue(7);
    if (const char* backend = std::getenv("PATINA_HYDRA_BACKEND"))
        options.settings[TfToken("backend")] = VtValue(std::string(backend));
    return options;
}

class HydraEdits : public testing::TestWithParam<bool> {
protected:
    static std::string difference(Host& edited, Host& fresh) {
        // UsdImagingDelegate names instancers after whichever instance it met first.
        std::string text;
        if (edited.options().sceneIndex) text = differences(sceneText(edited), sceneText(fresh));
        const int pixels = differentPixels(edited.read("color"), fresh.read("color"));
        if (pixels != 0) text += std::to_string(pixels) + " pixels differ";
        return text;
    }

    /// Both hosts show the same stage: as text (scene indices), and every bit of the picture. Where
    /// UsdImaging's scene indices themselves are no longer those of a new host, the edited host has
    /// to show what they say.
    /// @param follows whether they still were
    static void expectSame(Host& edited, const UsdStageRefPtr& stage, const std::string& after,
                           bool& follows) {
        edited.setSize(24, 24);
        edited.setAovs({HostAov()});
        ASSERT_TRUE(edited.render(patience)) << after;
        Host fresh(stage, edited.options());
        ASSERT_TRUE(fresh.render(patience)) << after;
        const std::string found = difference(edited, fresh);
        follows = found.empty();
        if (follows) return;
        ASSERT_TRUE(edited.options().sceneIndex)
            << "edited and fresh host differ after " << after << "\n"
            << found;
        Host same(stage, edited.options(), &edited);
        ASSERT_TRUE(same.render(patience)) << after;
        ASSERT_EQ(difference(edited, same), "")
            << "edited and fresh host of the same scene indices differ after " << after;
    }
};

} // namespace

TEST_P(HydraEdits, EndLikeAFreshHost) {
    if (GetParam() && !PATINA_HAS_SUBSET_NOTICES)
        GTEST_SKIP() << "scene indices of this OpenUSD tell no mesh that its subsets changed";
    const UsdStageRefPtr stage = makeBaseStage();
    std::optional<Host> host;
    host.emplace(stage, optionsFor(GetParam()));
    const uint32_t seed = uint32_t(number("PATINA_HYDRA_SEED", 20240817));
    RandomEdits edits(stage, *host, seed);
    Random pace(seed + 1);
    const int count = number("PATINA_HYDRA_EDITS", 400);
    // Differences are found near their cause, but most edits meet a render that goes on.
    const int between = std::max(count / 40, 10);
    std::string recent;
    int lost = 0;
    for (int i = 1; i <= count; ++i) {
        recent += edits.apply() + " ";
        const bool compares = i % between == 0 || i == count;
        try {
            if (pace.chance(0.6f) || compares) host->execute();
        } catch (const UsdExpiredPrimAccessError&) {
            // Then isLost() says so.
        }
        bool follows = !host->isLost();
        if (pace.chance(0.1f))
            std::this_thread::sleep_for(std::chrono::microseconds(pace.index(3000)));
        if (compares && follows) {
            expectSame(*host, stage, std::to_string(i) + " edits, the last of them " + recent,
                       follows);
            if (HasFatalFailure()) return;
            recent.clear();
        }
        if (!follows) {
            const HostOptions options = host->options();
            host.emplace(stage, options);
            ++lost;
        }
    }
    // UsdImaging's scene indices now and then ask a prim that is gone, or go on counting a native
    // instance that is none any more (seen in 24.11).
    EXPECT_LE(lost, 1 + count / 500);
    if (lost > 0) std::cout << "OpenUSD lost the stage " << lost << " times\n";
}

INSTANTIATE_TEST_SUITE_P(Inputs, HydraEdits, testing::Bool(), inputName);
