// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/renderStats.h"

#include <pxr/base/tf/stringUtils.h>

#include <sys/resource.h>

namespace patina {

namespace {

double peakMemory() {
    rusage usage{};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? double(usage.ru_maxrss) * 1024.0 : 0.0;
}

std::string annotation(const HdPatinaDelegateState& state, const RenderProgress& p) {
    if (p.failed) return "Failed: " + p.error;
    if (state.stopped()) return "Stopped";
    if (state.paused()) return "Paused";
    if (p.converged)
        return TfStringPrintf("Done: %.0f samples in %.1f s", p.samplesMean, p.secondsRendering);
    if (p.samplesDone == 0) return "Preparing";
    const std::string noise =
        p.noiseWanted > 0.0 && p.noise >= 0.0
            ? TfStringPrintf("noise %.2g %% of %.2g %%, ", 100.0 * p.noise, 100.0 * p.noiseWanted)
            : "";
    return noise + TfStringPrintf("%.0f samples, %.1f s left", p.samplesMean, p.secondsLeft);
}

} // namespace

VtDictionary renderStats(const HdPatinaDelegateState& state) {
    RenderProgress slowest;
    bool found = false;
    int shown = 0, onDevice = 0;
    for (const auto& session : state.sessions()) {
        const RenderProgress p = session->progress();
        const bool started = session->isRunning() || p.converged || p.failed || p.samplesDone > 0;
        if (started && (!found || p.fraction < slowest.fraction)) {
            slowest = p;
            shown = session->imagesShown();
            onDevice = session->imagesOnDevice();
        }
        found |= started;
    }
    VtDictionary stats;
    stats["percentDone"] = VtValue(100.0 * slowest.fraction);
    stats["fractionDone"] = VtValue(slowest.fraction);
    stats["numCompletedSamples"] = VtValue(slowest.samplesDone);
    stats["patina:imagesShown"] = VtValue(double(shown));
    stats["patina:imagesOnDevice"] = VtValue(double(onDevice));
    stats["patina:imagesByMemory"] = VtValue(state.hostTextures->whyNot());
    stats["totalClockTime"] = VtValue(slowest.secondsRendering);
    stats["timeRemaining"] = VtValue(slowest.secondsLeft);
    stats["renderProgressAnnotation"] = VtValue(annotation(state, slowest));
    stats["patina:backend"] = VtValue(slowest.backend);
    stats["peakMemory"] = VtValue(peakMemory());
    stats["warnings"] = VtValue(state.param.scene()->diagnostics().count());
    for (const auto& item : slowest.statistics)
        stats["patina:" + item.first] = VtValue(item.second);
    for (const auto& session : state.sessions())
        for (const auto& item : session->mattes())
            stats[item.first] = VtValue(std::get<std::string>(item.second));
    return stats;
}

} // namespace patina
