// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/splatTiles.h"

#include "hdDelegate/parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace patina {

SplatWindow::SplatWindow(const SplatKernel& kernel, const mat4& localToClip) {
    const vec4 center = localToClip * vec4(kernel.center, 1.0f);
    const float radius = std::sqrt(kernel.reach) * (1.0f + 1e-4f);
    vec4 axes[3]; // of the ellipsoid where the kernel ends
    for (int i = 0; i < 3; ++i) {
        const vec3 row(kernel.toUnit[0][i], kernel.toUnit[1][i], kernel.toUnit[2][i]);
        axes[i] = localToClip * vec4(row * (radius / glm::dot(row, row)), 0.0f);
    }
    const vec3 w(axes[0].w, axes[1].w, axes[2].w);
    const float ww = glm::dot(w, w) - center.w * center.w;
    crosses = !(ww < -1e-5f * center.w * center.w);
    shows = crosses || center.w > 0.0f;
    if (crosses || !shows) return;
    for (int a = 0; a < 2; ++a) {
        middle[a] = center[a] / center.w;
        // Relative to the middle, so that no digits are lost.
        const vec3 x = vec3(axes[0][a], axes[1][a], axes[2][a]) - middle[a] * w;
        const float xw = glm::dot(x, w);
        const float root = std::sqrt(std::max(xw * xw - glm::dot(x, x) * ww, 0.0f));
        low[a] = middle[a] + (xw + root) / ww;
        high[a] = middle[a] + (xw - root) / ww;
    }
}

namespace {

constexpr int usual = 3;       ///< doublings of a pixel to the side of a tile
constexpr size_t chunk = 2048; ///< kernels
/// Entries of a tile: llvmpipe ends loops early, those of 16384 turns among them.
constexpr uint32_t longest = 8192;

struct Rect { ///< pixels, the last ones too; at first none
    uint16_t fromX = 1, fromY = 1, toX = 0, toY = 0;
};

/// Rays through the window, in the world.
class WindowRays {
public:
    explicit WindowRays(const RasterView& view) : _view(view) {
        const auto near = [&](float x, float y) {
            const vec4 p = view.clipToWorld * vec4(x, y, -1.0f, 1.0f);
            return vec3(p) / p.w;
        };
        _middle = near(0, 0);
        _right = near(1, 0) - _middle;
        _up = near(0, 1) - _middle;
    }
    void at(const vec2& p, vec3& origin, vec3& direction) const {
        const vec3 near = _middle + p.x * _right + p.y * _up;
        origin = _view.perspective ? _view.eye : near;
        direction = _view.perspective ? glm::normalize(near - _view.eye) : _view.forward;
    }

private:
    const RasterView& _view;
    vec3 _middle, _right, _up;
};

} // namespace

SplatTiles::SplatTiles(const std::vector<RasterSplatPlace>& placed, const RasterView& view,
                       int width, int height, size_t most) {
    struct Chunk {
        uint32_t place;
        size_t first, end; ///< of the place's kernels
        size_t rects;      ///< where those of them begin
    };
    std::vector<Chunk> chunks;
    size_t rectCount = 0;
    std::vector<mat4> toClip;
    for (size_t p = 0; p < placed.size(); ++p) {
        const size_t kernels = placed[p].kernels->list().size();
        toClip.push_back(mat4(glm::dmat4(view.worldToClip) * glm::dmat4(placed[p].toWorld)));
        for (size_t i = 0; i < kernels; i += chunk, rectCount += chunk)
            chunks.push_back({uint32_t(p), i, std::min(i + chunk, kernels), rectCount});
    }
    const vec2 size(width, height);
    const ivec2 last(width - 1, height - 1);
    std::vector<Rect> rects(rectCount);
    const auto forKernels = [&](const auto& visit) {
        parallelFor(size_t(0), chunks.size(), [&](size_t c) {
            const Chunk& part = chunks[c];
            for (size_t i = part.first; i < part.end; ++i)
                visit(part.place, uint32_t(i), rects[part.rects + i - part.first]);
        });
    };
    forKernels([&](uint32_t place, uint32_t i, Rect& rect) {
        const SplatWindow window(placed[place].kernels->list()[i], toClip[place]);
        if (!window.shows) return;
        constexpr float slack = 0.05f; // pixels, for rounding
        const vec2 from = (0.5f * window.low + 0.5f) * size - slack;
        const vec2 to = (0.5f * window.high + 0.5f) * size + slack;
        if (!(to.x >= 0.0f && to.y >= 0.0f && from.x <= size.x && from.y <= size.y)) return;
        const ivec2 a(glm::clamp(from, vec2(0.0f), vec2(last))),
            b(glm::clamp(to, vec2(0.0f), vec2(last)));
        rect = {uint16_t(a.x), uint16_t(a.y), uint16_t(b.x), uint16_t(b.y)};
    });
    const auto visitTiles = [&](const Rect& r, int shift, const auto& visit) {
        for (int y = r.fromY >> shift; y <= r.toY >> shift; ++y)
            for (int x = r.fromX >> shift; x <= r.toX >> shift; ++x)
                visit(size_t(y) * size_t((last.x >> shift) + 1) + size_t(x));
    };
    const auto entriesWith = [&](int shift) {
        std::atomic<size_t> all{0};
        forKernels([&](uint32_t, uint32_t, const Rect& r) {
            if (r.toX >= r.fromX)
                all += size_t((r.toX >> shift) - (r.fromX >> shift) + 1) *
                       size_t((r.toY >> shift) - (r.fromY >> shift) + 1);
        });
        return size_t(all);
    };
    std::vector<std::atomic<uint32_t>> next;
    const auto longestWith = [&](int shift) {
        next = std::vector<std::atomic<uint32_t>>(size_t((last.x >> shift) + 1) *
                                                  size_t((last.y >> shift) + 1));
        forKernels([&](uint32_t, uint32_t, const Rect& r) {
            visitTiles(r, shift,
                       [&](size_t tile) { next[tile].fetch_add(1, std::memory_order_relaxed); });
        });
        return uint32_t(*std::max_element(next.begin(), next.end()));
    };
    // Smaller in small images, since the order along one ray has to be nearly right for a tile.
    int shift = 0;
    while (shift < usual && 32 << shift <= std::max(width, height))
        ++shift;
    while (entriesWith(shift) > most && (last.x >> shift) + (last.y >> shift) > 0)
        ++shift;
    while (longestWith(shift) > longest && shift > 0 && entriesWith(shift - 1) <= most)
        --shift;
    side = 1 << shift;
    across = (last.x >> shift) + 1;
    const size_t tiles = next.size();
    first.assign(tiles + 1, 0);
    for (size_t t = 0; t < tiles; ++t) {
        first[t + 1] = first[t] + next[t];
        next[t] = first[t];
    }
    entries.resize(first[tiles]);
    forKernels([&](uint32_t place, uint32_t i, const Rect& r) {
        visitTiles(r, shift, [&](size_t tile) {
            entries[next[tile].fetch_add(1, std::memory_order_relaxed)] = {place, i};
        });
    });
    // Threads have come in any order, which sorting makes good.
    const WindowRays rays(view);
    parallelFor(size_t(0), tiles, [&](size_t tile) {
        const vec2 corner(float(tile % size_t(across)) * float(side),
                          float(tile / size_t(across)) * float(side));
        const vec2 low = 2.0f * corner / size - 1.0f;
        const vec2 high = 2.0f * (corner + float(side)) / size - 1.0f;
        struct Sorted {
            float distance;
            Entry entry;
        };
        std::vector<Sorted> list;
        for (uint32_t e = first[tile]; e < first[tile + 1]; ++e) {
            const RasterSplatPlace& place = placed[entries[e].place];
            const SplatKernel& kernel = place.kernels->list()[entries[e].kernel];
            const vec4 clip = toClip[entries[e].place] * vec4(kernel.center, 1.0f);
            const vec2 middle = clip.w > 0.0f ? vec2(clip) / clip.w : 0.5f * (low + high);
            vec3 origin, direction;
            rays.at(glm::clamp(middle, low, high), origin, direction);
            const float distance = shSplats::splatPoint(kernel.shape, kernel.center, kernel.toUnit,
                                                        vec3(place.toLocal * vec4(origin, 1.0f)),
                                                        mat3(place.toLocal) * direction)
                                       .distance;
            list.push_back({std::isnan(distance) ? INFINITY : distance, entries[e]});
        }
        std::sort(list.begin(), list.end(), [](const Sorted& a, const Sorted& b) {
            if (a.distance != b.distance) return a.distance < b.distance;
            if (a.entry.place != b.entry.place) return a.entry.place < b.entry.place;
            return a.entry.kernel < b.entry.kernel;
        });
        for (size_t i = 0; i < list.size(); ++i) {
            const Entry& entry = list[i].entry;
            entries[first[tile] + i] = {entry.place,
                                        placed[entry.place].firstKernel + entry.kernel};
        }
    });
}

} // namespace patina
