// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/splitting.h"

#include "hdDelegate/film/sampler.h"
#include "hdDelegate/parallel.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina {

namespace {

constexpr int mostPixels = 1024, leastPixels = 16, pixelsForEach = 16;
constexpr int samples = 2;          // of each of them
constexpr double dark = 0.1;        // of the mean luminance: darker pixels do not decide
constexpr double worthwhile = 0.95; // of the product of a cheaper choice

/// Of a sample that takes one light sample and one branch: what each part adds to its cost and to
/// the variance, relative to the square of the pixel.
struct Parts {
    double rest = 0.0, light = 0.0, branch = 0.0;

    double with(const Splitting& s) const {
        return rest + light * s.lightSamples + branch * s.branches;
    }
    double divided(const Splitting& s) const {
        return rest + light / s.lightSamples + branch / s.branches;
    }
};

double relative(const vec3& difference, const vec3& mean, double floor) {
    if (difference == vec3(0.0f)) return 0.0; // of a black image, say
    double sum = 0.0;
    for (int c = 0; c < 3; ++c)
        sum += double(difference[c]) * difference[c] / (double(mean[c]) * mean[c] + floor * floor);
    return sum / 3.0;
}

bool isFinite(const SplitProbe& probe) {
    return std::isfinite(luminance(probe.color()));
}

} // namespace

void SplitProbe::begin(int step, const vec3& radiance, float cost) {
    _begun[step] = true;
    _radiance[step] = radiance;
    _cost[step] = cost;
}

void SplitProbe::end(const vec3& radiance, float cost) {
    _radiance[End] = radiance;
    _cost[End] = cost;
    for (int step = End; step-- > 0;)
        if (!_begun[step]) begin(step, _radiance[step + 1], _cost[step + 1]);
}

Splitting chooseSplitting(int width, int height, const Splitting& wanted,
                          const std::function<SplitProbe(int x, int y, uint32_t index)>& probe) {
    if (wanted.lightSamples > 0 && wanted.branches > 0) return wanted;
    const int pixels = int(std::clamp(double(width) * height / pixelsForEach, double(leastPixels),
                                      double(mostPixels)));
    std::vector<SplitProbe> probes(size_t(pixels * samples));
    parallelFor(0, pixels * samples, [&](int i) {
        const vec2 at = Sampler(0, 0, 0, uint32_t(i / samples)).next2() * vec2(width, height);
        probes[size_t(i)] = probe(int(at.x), int(at.y), uint32_t(i % samples));
    });

    double floor = 0.0;
    for (const SplitProbe& p : probes)
        if (isFinite(p)) floor += dark * luminance(glm::abs(p.color())) / double(probes.size());
    Parts cost, variance;
    for (size_t i = 0; i < probes.size(); i += samples) {
        const SplitProbe &a = probes[i], &b = probes[i + 1];
        if (!isFinite(a) || !isFinite(b)) continue;
        const vec3 mean = 0.5f * (a.color() + b.color());
        variance.rest += 0.5 * relative(a.color() - b.color(), mean, floor);
        for (const SplitProbe* p : {&a, &b}) {
            const vec3 light =
                p->radiance(SplitProbe::LightSample) - p->radiance(SplitProbe::SecondLightSample);
            const vec3 branch =
                p->radiance(SplitProbe::Branch) - p->radiance(SplitProbe::SecondBranch);
            variance.rest -= 0.5 * (relative(light, mean, floor) + relative(branch, mean, floor));
            // The other sample says how bright the pixel is: it knows nothing of this one's luck.
            const vec3 color = (p == &a ? b : a).color();
            variance.light += relative(light, color, floor);
            variance.branch += relative(branch, color, floor);
            const double lights =
                p->cost(SplitProbe::LightSample) + p->cost(SplitProbe::SecondLightSample);
            const double branches = p->cost(SplitProbe::Branch) + p->cost(SplitProbe::SecondBranch);
            cost.light += 0.5 * lights;
            cost.branch += 0.5 * branches;
            cost.rest += p->cost() - lights - branches;
        }
    }
    variance.rest = std::max(0.0, variance.rest);

    const auto options = [](int fixed, int most) {
        std::vector<int> counts;
        for (int n = 1; n <= most; n *= 2)
            counts.push_back(fixed > 0 ? fixed : n);
        return counts;
    };
    std::vector<Splitting> choices;
    for (int lightSamples : options(wanted.lightSamples, Splitting::mostLightSamples))
        for (int branches : options(wanted.branches, Splitting::mostBranches))
            choices.push_back({lightSamples, branches});
    const auto product = [&](const Splitting& s) { return cost.with(s) * variance.divided(s); };
    Splitting best = choices.front(), cheapest = best;
    for (const Splitting& choice : choices)
        if (product(choice) < product(best)) best = cheapest = choice;
    for (const Splitting& choice : choices)
        if (worthwhile * product(choice) <= product(best) &&
            cost.with(choice) < cost.with(cheapest))
            cheapest = choice;
    return cheapest;
}

} // namespace patina
