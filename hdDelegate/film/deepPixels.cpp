// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/deepPixels.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Of a depth: what lies closer is one sample.
constexpr float nearlyOne = 1.0f / 1024.0f;

} // namespace

DeepPixels::DeepPixels(int width, int height, int most)
    : _width(width), _height(height), _most(size_t(std::max(most, 2))),
      _cells(size_t(width) * size_t(height)) {}

void DeepPixels::Bin::add(const DeepEvent& event) {
    front = std::min(front, inVolume ? event.depth : front);
    back = std::max(back, inVolume ? event.depth : back);
    alpha += double(event.alpha);
    color += glm::dvec3(event.color);
}

void DeepPixels::add(int x, int y, const DeepEvent* events, int count) {
    Cell& cell = _cells[size_t(y) * size_t(_width) + size_t(x)];
    ++cell.rays;
    for (int i = 0; i < count; ++i) {
        DeepEvent event = events[i];
        if (!std::isfinite(event.depth)) event.depth = deepBackground;
        if (event.alpha != 0.0f || event.color != glm::vec3(0.0f)) insert(cell.bins, event);
    }
    while (cell.bins.size() > _most)
        mergeClosest(cell.bins);
}

void DeepPixels::insert(std::vector<Bin>& bins, const DeepEvent& event) const {
    const float z = event.depth, close = nearlyOne * std::abs(z);
    // The first bin behind; before it are those that begin at z or nearer.
    const auto next = std::upper_bound(
        bins.begin(), bins.end(), z, [](float depth, const Bin& bin) { return depth < bin.front; });
    const auto takes = [&](const Bin& bin) {
        return bin.inVolume == event.inVolume && z >= bin.front - close && z <= bin.back + close;
    };
    if (next != bins.begin() && takes(*std::prev(next))) return std::prev(next)->add(event);
    const bool within = next != bins.begin() && std::prev(next)->back > z; // a volume is cut there
    if (next != bins.end() && !within && takes(*next)) return next->add(event);
    Bin fresh;
    fresh.front = fresh.back = z;
    fresh.inVolume = event.inVolume;
    fresh.add(event);
    const size_t at = size_t(next - bins.begin());
    if (within) {
        Bin& before = bins[at - 1];
        Bin behind = before;
        const double share = double(z - before.front) / double(before.back - before.front);
        before.back = behind.front = z;
        before.alpha *= share, before.color *= share;
        behind.alpha *= 1.0 - share, behind.color *= 1.0 - share;
        bins.insert(next, behind);
    }
    bins.insert(bins.begin() + ptrdiff_t(at), fresh);
}

/// Surfaces become one at their mean depth; with a volume in it, a volume that holds both.
void DeepPixels::mergeClosest(std::vector<Bin>& bins) {
    constexpr float unlike = 1000.0f; // times that a surface and a volume count as farther apart
    size_t best = 0;
    float least = INFINITY;
    for (size_t i = 0; i + 1 < bins.size(); ++i) {
        const Bin &a = bins[i], &b = bins[i + 1];
        const float gap = (b.back - a.front) / std::max(std::abs(a.front), 1e-30f) *
                          (a.inVolume == b.inVolume ? 1.0f : unlike);
        if (gap < least) least = gap, best = i;
    }
    Bin& a = bins[best];
    const Bin& b = bins[best + 1];
    const double sum = a.alpha + b.alpha, share = sum > 0.0 ? b.alpha / sum : 0.5;
    if (a.inVolume || b.inVolume) {
        a.inVolume = true;
        a.back = b.back;
    } else {
        a.front = a.back = float(double(a.front) + (double(b.front) - double(a.front)) * share);
    }
    a.alpha = sum;
    a.color += b.color;
    bins.erase(bins.begin() + ptrdiff_t(best) + 1);
}

/// What lies behind is seen through what is left open: a share of the light is stored over that, so
/// that putting samples over each other gives the sum again. What is left follows the stored
/// numbers, so that their rounding does not add up.
std::vector<DeepSample> DeepPixels::resolve(int x, int y) const {
    const Cell& cell = _cells[size_t(y) * size_t(_width) + size_t(x)];
    std::vector<DeepSample> samples;
    double left = 1.0, covered = 0.0;
    for (const Bin& bin : cell.bins) {
        const double rays = cell.rays;
        covered += bin.alpha / rays;
        if (!(left > 0.5 / rays)) { // light without coverage, of rays that ended before
            samples.back().color += glm::vec3(bin.color / rays);
            continue;
        }
        DeepSample sample;
        sample.front = bin.front;
        sample.back = bin.back;
        sample.alpha = float(std::clamp(1.0 - (1.0 - covered) / left, 0.0, 1.0));
        sample.color = glm::vec3(bin.color / (rays * left));
        left *= 1.0 - double(sample.alpha);
        samples.push_back(sample);
    }
    return samples;
}

} // namespace patina
