// SPDX-License-Identifier: Apache-2.0
// Frames of a sequence, averaged along their motion.

#include "hdDelegate/film/denoiser.h"
#include "hdDelegate/parallel.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace patina {

namespace {

// How much one step of a chain may differ by, and still see the same surface.
constexpr float roundTrip = 0.5f, roundTripShare = 0.1f; // pixels, and of the way
constexpr float depthShare = 0.1f, normalDifference = 0.2f, alphaDifference = 0.15f;
constexpr float noDepth = 1e9f;                          // and beyond: no surface in view
constexpr float albedoFloor = 0.05f, albedoRatio = 1.5f; // added to albedos; largest ratio of them

/// A window of pixels whose mean difference is tested, and how many standard errors of that mean
/// are chance: full weight up to half below, none from half above. The smaller one has a lower
/// limit, since a step across it widens its own scatter: of 9 pixels, 3 that differ have 2 errors.
struct Window {
    int radius;
    float limit;
};
constexpr std::array<Window, 3> windows = {Window{1, 2.0f}, Window{3, 3.0f}, Window{7, 3.0f}};
constexpr int halo = windows.back().radius;
constexpr int fewestPairs = 4;   // that tell of a scatter
constexpr float unseen = 0.002f; // of the level: a difference that counts as none
constexpr int bandHeight = 32;

/// Where few pixels of a window have a pair (hair, leaves), none has weight: a bright pixel among
/// others that are means of many frames would pass for a light.
constexpr int shareRadius = 3;
constexpr float noShare = 0.75f, fullShare = 0.9f;

struct View {
    const SequenceFrame& frame;
    int width, height;

    size_t index(int x, int y) const { return size_t(y) * size_t(width) + size_t(x); }
    glm::vec3 color(size_t i) const { return vec3(frame.color, i); }
    glm::vec3 albedo(size_t i) const { return vec3(frame.albedo, i); }
    glm::vec3 normal(size_t i) const { return vec3(frame.normal, i); }
    glm::vec2 motion(size_t i, bool later) const {
        const float* from = (later ? frame.later : frame.earlier) + 2 * i;
        return {from[0], from[1]};
    }
    float samples(size_t i) const {
        const float n = frame.samples ? frame.samples[i] : 1.0f;
        return n > 0.0f && std::isfinite(n) ? n : 0.0f;
    }
    bool hasColor(size_t i) const { return finite(color(i)) && samples(i) > 0.0f; }
    /// Whether the pixel sees a surface that can be followed.
    bool hasSurface(size_t i) const {
        return frame.depth[i] < noDepth && std::isfinite(frame.depth[i]) && finite(albedo(i)) &&
               finite(normal(i)) && std::isfinite(frame.alpha[i]);
    }

private:
    static glm::vec3 vec3(const float* from, size_t i) {
        return {from[3 * i], from[3 * i + 1], from[3 * i + 2]};
    }
    static bool finite(const glm::vec3& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    }
};

glm::vec3 ratio(const View& to, size_t p, const View& from, size_t q) {
    const glm::vec3 floor(albedoFloor), zero(0.0f);
    return (glm::max(to.albedo(p), zero) + floor) / (glm::max(from.albedo(q), zero) + floor);
}

/// Whether texel q of a frame sees the surface that texel p of the frame beside it does.
bool sameSurface(const View& a, size_t p, const View& b, size_t q, bool later) {
    const glm::vec2 way = a.motion(p, later), back = b.motion(q, !later);
    if (!(glm::length(way + back) <= roundTrip + roundTripShare * glm::length(way))) return false;
    const float za = a.frame.depth[p], zb = b.frame.depth[q];
    return std::abs(za - zb) <= depthShare * std::max(za, zb) &&
           glm::length(a.normal(p) - b.normal(q)) <= normalDifference &&
           std::abs(a.frame.alpha[p] - b.frame.alpha[q]) <= alphaDifference;
}

/// Where each pixel of the current frame is found in another.
struct Chain {
    std::vector<int32_t> texel;   ///< -1: it is not
    std::vector<glm::vec2> place; ///< pixels; whole numbers are centres

    explicit Chain(const View& view)
        : texel(size_t(view.width) * size_t(view.height)), place(texel.size()) {
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const size_t i = view.index(x, y);
                texel[i] = view.hasSurface(i) ? int32_t(i) : -1;
                place[i] = {x, y};
            }
    }

    /// From frame a to b, which is beside it.
    void step(const View& a, const View& b, bool later) {
        parallelFor(0, a.height, [&](int y) {
            for (int x = 0; x < a.width; ++x)
                follow(a.index(x, y), a, b, later);
        });
    }

private:
    void follow(size_t i, const View& a, const View& b, bool later) {
        if (texel[i] < 0) return;
        const size_t p = size_t(texel[i]);
        texel[i] = -1;
        const glm::vec2 at = place[i] + a.motion(p, later);
        // NaN and what lies outside
        if (!(at.x > -1.0f && at.y > -1.0f && at.x < float(b.width) && at.y < float(b.height)))
            return;
        place[i] = at;
        const int left = int(std::floor(at.x)), top = int(std::floor(at.y));
        float nearest = 4.0f; // squared; no texel of the four is as far
        for (int k = 0; k < 4; ++k) {
            const int u = left + (k & 1), v = top + (k >> 1);
            if (u < 0 || v < 0 || u >= b.width || v >= b.height) continue;
            const glm::vec2 off = glm::vec2(u, v) - at;
            const float distance = glm::dot(off, off);
            const size_t q = b.index(u, v);
            if (distance >= nearest || !b.hasSurface(q) || !sameSurface(a, p, b, q, later))
                continue;
            nearest = distance;
            texel[i] = int32_t(q);
        }
    }
};

/// Sums over windows of a band of rows: differences, their squares, levels, how many pairs there
/// are and how many pixels could have one.
class Band {
public:
    enum Plane { Difference = 0, Square = 3, Level = 6, Count = 9, Known = 10, planes = 11 };

    Band(int width, int rows) : _width(width), _rows(rows) {
        for (auto* set : {&_values, &_across, &_sums})
            for (std::vector<float>& plane : *set)
                plane.assign(size_t(width) * size_t(rows), 0.0f);
    }
    float& value(int plane, int x, int row) { return _values[size_t(plane)][index(x, row)]; }
    float sum(int plane, int x, int row) const { return _sums[size_t(plane)][index(x, row)]; }

    void sumWindows(int radius) {
        for (size_t plane = 0; plane < planes; ++plane) {
            for (int row = 0; row < _rows; ++row)
                for (int x = 0; x < _width; ++x) {
                    float sum = 0.0f;
                    const int end = std::min(_width - 1, x + radius);
                    for (int u = std::max(0, x - radius); u <= end; ++u)
                        sum += _values[plane][index(u, row)];
                    _across[plane][index(x, row)] = sum;
                }
            for (int row = 0; row < _rows; ++row) {
                float* to = &_sums[plane][index(0, row)];
                std::fill(to, to + _width, 0.0f);
                const int end = std::min(_rows - 1, row + radius);
                for (int v = std::max(0, row - radius); v <= end; ++v) {
                    const float* from = &_across[plane][index(0, v)];
                    for (int x = 0; x < _width; ++x)
                        to[x] += from[x];
                }
            }
        }
    }

    /// @returns the weight that the share of pixels with a pair leaves
    float shared(int x, int row) const {
        const float share = sum(Count, x, row) / std::max(1.0f, sum(Known, x, row));
        return std::clamp((share - noShare) / (fullShare - noShare), 0.0f, 1.0f);
    }

    /// @returns the weight that a window's mean difference leaves, 1 where it has too few pairs
    float weight(int x, int row, const Window& window) const {
        const float n = sum(Count, x, row);
        if (n < float(fewestPairs)) return 1.0f;
        float least = 1.0f;
        for (int c = 0; c < 3; ++c) {
            const float mean = sum(Difference + c, x, row) / n;
            const float scatter =
                std::max(0.0f, sum(Square + c, x, row) / n - mean * mean) / (n - 1.0f);
            const float floor = unseen * std::abs(sum(Level + c, x, row) / n);
            const float error = std::sqrt(scatter + floor * floor);
            const float t = std::abs(mean) / std::max(error, 1e-20f);
            least = std::min(least, window.limit + 0.5f - t);
        }
        return std::max(least, 0.0f);
    }

private:
    size_t index(int x, int row) const { return size_t(row) * size_t(_width) + size_t(x); }

    int _width, _rows;
    std::array<std::vector<float>, planes> _values, _across, _sums;
};

/// Sums of what was taken so far.
struct Sums {
    std::vector<float> color, samples, frames;
};

void addBand(const View& own, const View& other, const Chain& chain, int top, Sums& sums) {
    const int first = std::max(0, top - halo);
    const int bottom = std::min(own.height, top + bandHeight),
              last = std::min(own.height, bottom + halo);
    Band band(own.width, last - first);
    for (int y = first; y < last; ++y)
        for (int x = 0; x < own.width; ++x) {
            const size_t p = own.index(x, y);
            const int32_t q = chain.texel[p];
            band.value(Band::Known, x, y - first) = own.hasSurface(p) ? 1.0f : 0.0f;
            if (q < 0 || !own.hasColor(p) || !other.hasColor(size_t(q))) continue;
            const glm::vec3 mine = own.color(p);
            const glm::vec3 d = other.color(size_t(q)) * ratio(own, p, other, size_t(q)) - mine;
            for (int c = 0; c < 3; ++c) {
                band.value(Band::Difference + c, x, y - first) = d[c];
                band.value(Band::Square + c, x, y - first) = d[c] * d[c];
                band.value(Band::Level + c, x, y - first) = mine[c];
            }
            band.value(Band::Count, x, y - first) = 1.0f;
        }
    std::vector<float> weights(size_t(own.width) * size_t(bottom - top), 1.0f);
    for (const Window& window : windows) {
        band.sumWindows(window.radius);
        for (int y = top; y < bottom; ++y)
            for (int x = 0; x < own.width; ++x) {
                float& weight = weights[own.index(x, y - top)];
                weight = std::min(weight, band.weight(x, y - first, window));
                if (window.radius == shareRadius) weight *= band.shared(x, y - first);
            }
    }
    for (int y = top; y < bottom; ++y)
        for (int x = 0; x < own.width; ++x) {
            const size_t p = own.index(x, y);
            const float weight = weights[own.index(x, y - top)];
            if (chain.texel[p] < 0 || weight <= 0.0f) continue;
            const size_t q = size_t(chain.texel[p]);
            if (!other.hasColor(q)) continue;
            const glm::vec3 by = ratio(own, p, other, q);
            if (std::max({by.x, by.y, by.z, 1.0f / by.x, 1.0f / by.y, 1.0f / by.z}) > albedoRatio)
                continue;
            const float n = weight * other.samples(q);
            const glm::vec3 color = n * by * other.color(q);
            for (int c = 0; c < 3; ++c)
                sums.color[3 * p + size_t(c)] += color[c];
            sums.samples[p] += n;
            sums.frames[p] += weight;
        }
}

} // namespace

Accumulated accumulate(const std::vector<SequenceFrame>& frames, size_t current, int width,
                       int height, int threads) {
    const size_t count = size_t(width) * size_t(height);
    const View own{frames.at(current), width, height};
    Sums sums{std::vector<float>(3 * count), std::vector<float>(count), std::vector<float>(count)};
    for (size_t i = 0; i < count; ++i) {
        if (!own.hasColor(i)) continue;
        const float n = own.samples(i);
        for (int c = 0; c < 3; ++c)
            sums.color[3 * i + size_t(c)] = n * own.color(i)[c];
        sums.samples[i] = n;
        sums.frames[i] = 1.0f;
    }
    Arena(threads).execute([&] {
        for (const bool later : {false, true}) {
            Chain chain(own);
            size_t at = current;
            while (later ? at + 1 < frames.size() : at > 0) {
                const View from{frames[at], width, height};
                at = later ? at + 1 : at - 1;
                const View to{frames[at], width, height};
                chain.step(from, to, later);
                parallelFor(0, (height + bandHeight - 1) / bandHeight,
                            [&](int band) { addBand(own, to, chain, band * bandHeight, sums); });
            }
        }
    });
    for (size_t i = 0; i < count; ++i) {
        // Of one frame alone: its own bits.
        const bool alone = sums.frames[i] == 1.0f && own.hasColor(i);
        for (size_t c = 0; c < 3; ++c)
            sums.color[3 * i + c] = alone ? frames[current].color[3 * i + c]
                                    : sums.samples[i] > 0.0f
                                        ? sums.color[3 * i + c] / sums.samples[i]
                                        : 0.0f;
    }
    return {std::move(sums.color), std::move(sums.frames)};
}

} // namespace patina
