// SPDX-License-Identifier: Apache-2.0
// hydraHost: renders a stage through Hydra from the command line.

#include "testenv/hydra/host/clock.h"
#include "testenv/hydra/host/commandLine.h"
#include "testenv/hydra/host/editScript.h"
#include "testenv/hydra/host/report.h"

#include <pxr/base/tf/stringUtils.h>
#include <pxr/usd/usdGeom/camera.h>

#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <unistd.h>

using namespace patina;

namespace {

/// Moves the camera a little, in the session layer.
void moveCamera(const UsdStageRefPtr& stage, const SdfPath& path, int step) {
    stage->SetEditTarget(stage->GetSessionLayer());
    const UsdGeomXformable camera(stage->GetPrimAtPath(path));
    if (!camera) throw std::runtime_error("there is no camera " + path.GetString());
    bool resets = false;
    GfMatrix4d matrix;
    camera.GetLocalTransformation(&matrix, &resets, UsdTimeCode::Default());
    matrix.SetTranslateOnly(matrix.ExtractTranslation() + GfVec3d(0.001 * (step + 1), 0.0, 0.0));
    UsdGeomXformable(camera).MakeMatrixXform().Set(matrix);
}

void run(const CommandLine& line) {
    Clock clock;
    HostTimes times;
    const UsdStageRefPtr stage = UsdStage::Open(line.stage);
    if (!stage) throw std::runtime_error(line.stage + " cannot be opened");
    if (!stage->GetPrimAtPath(line.host.camera).IsA<UsdGeomCamera>())
        throw std::runtime_error("there is no camera '" + line.host.camera.GetString() + "'");
    times.emplace_back("open", clock.lap());
    Clock sinceOpened;
    Host host(stage, line.host);
    if (!line.edits.empty()) runEditScript(host, stage, line.edits);
    const double made = sinceOpened.lap();
    if (!host.render(line.limit)) throw std::runtime_error("the image does not converge");
    times.emplace_back("render", clock.lap());
    times.emplace_back("seen", made + host.secondsUntilSeen());
    for (int i = 0; i < line.repeats; ++i) {
        moveCamera(stage, host.options().camera, i);
        if (!host.render(line.limit)) throw std::runtime_error("the image does not converge");
        times.emplace_back("moved" + std::to_string(i), clock.lap());
        times.emplace_back("movedSeen" + std::to_string(i), host.secondsUntilSeen());
    }
    if (!line.image.empty()) writeExr(line.image, host.readAll());
    if (!line.dump.empty() && !host.dumpScene(line.dump))
        throw std::runtime_error("the scene cannot be written to " + line.dump);
    if (line.json.empty()) return;
    JsObject report = statisticsOf(host, times);
    report["picks"] = JsValue(line.pickAll ? allPicksOf(host) : picksOf(host, line.picks));
    writeJson(report, line.json);
}

int attempt(const std::vector<std::string>& words) {
    try {
        const CommandLine line = parseCommandLine(words);
        if (line.help) {
            std::fputs(usage, stdout);
            return 0;
        }
        run(line);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "hydraHost: %s\n", error.what());
        return 1;
    }
}

/// One command after the other, each a line of standard input: files for what it prints and for its
/// errors, and its words, with tabs between them. The answer is a line with its status. A start,
/// most of which is the linking of OpenUSD, takes longer than a small image.
void serve() {
    std::FILE* answers = fdopen(dup(STDOUT_FILENO), "w");
    for (std::string line; std::getline(std::cin, line);) {
        std::vector<std::string> words = TfStringSplit(line, "\t");
        if (words.size() < 2 || !std::freopen(words[0].c_str(), "w", stdout) ||
            !std::freopen(words[1].c_str(), "w", stderr))
            return;
        const int status = attempt({words.begin() + 2, words.end()});
        std::cout.flush();
        std::fflush(nullptr);
        std::fprintf(answers, "%d\n", status);
        std::fflush(answers);
    }
}

} // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> words(argv + 1, argv + argc);
    if (words != std::vector<std::string>{"--serve"}) return attempt(words);
    serve();
    return 0;
}
