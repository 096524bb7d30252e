// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/domePortals.h"

#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float largestBelowOne = 0x1.fffffep-1f;

/// Of an angle between -pi/2 and pi/2, in cells.
float cellsOf(float tangent) {
    return (std::atan(tangent) / pi + 0.5f) * float(DomePortal::size);
}
float tangentOf(float cells) {
    return std::tan((cells / float(DomePortal::size) - 0.5f) * pi);
}

/// Solid angle over the area of the map's angles, in radians: both tangents stretch their plane at
/// distance 1, which the direction sees at an angle.
float stretch(const vec3& w) {
    return (1.0f - w.x * w.x) * (1.0f - w.y * w.y) / std::max(w.z, 1e-20f);
}

constexpr float radiansPerCell = pi / float(DomePortal::size);

} // namespace

DomePortal::DomePortal(const mat4& toWorld, float width, float height,
                       const std::function<float(const vec3&)>& luminance)
    : _center(toWorld[3]) {
    const vec3 x(toWorld[0]), y(toWorld[1]);
    const float lengthX = glm::length(x);
    if (!(lengthX > 0.0f) || !std::isfinite(lengthX)) return;
    _x = x / lengthX;
    const vec3 across = y - glm::dot(y, _x) * _x;
    const float lengthY = glm::length(across);
    if (!(lengthY > 0.0f) || !std::isfinite(lengthY)) return;
    _y = across / lengthY;
    _z = glm::cross(_x, _y);
    if (glm::dot(_z, vec3(toWorld[2])) < 0.0f) _z = -_z;
    _half[0] = 0.5f * std::abs(width) * lengthX;
    _half[1] = 0.5f * std::abs(height) * lengthY;
    if (!(_half[0] * _half[1] > 0.0f) || !std::isfinite(_half[0] * _half[1])) return;

    _sums.assign(size_t(size + 1) * size_t(size + 1), 0.0);
    constexpr int parts = 2; // looked at within a cell, each way
    for (int j = 0; j < size; ++j) {
        double row = 0.0;
        for (int i = 0; i < size; ++i) {
            for (int k = 0; k < parts * parts; ++k) {
                const float across01 = (float(k % parts) + 0.5f) / float(parts);
                const float along01 = (float(k / parts) + 0.5f) / float(parts);
                const vec3 w = glm::normalize(
                    vec3(tangentOf(float(i) + across01), tangentOf(float(j) + along01), 1.0f));
                const float l = luminance(_x * w.x + _y * w.y + _z * w.z) * stretch(w);
                row += l > 0.0f && std::isfinite(l) ? double(l) : 0.0;
            }
            _sums[size_t(j + 1) * (size + 1) + size_t(i + 1)] =
                _sums[size_t(j) * (size + 1) + size_t(i + 1)] + row;
        }
    }
    _valid = _sums.back() > 0.0;
}

double DomePortal::sumTo(float x, float y) const {
    const int i = std::clamp(int(x), 0, size - 1), j = std::clamp(int(y), 0, size - 1);
    const double tx = double(x) - i, ty = double(y) - j;
    const double* low = &_sums[size_t(j) * (size + 1) + size_t(i)];
    const double* high = low + size + 1;
    return (low[0] * (1.0 - tx) + low[1] * tx) * (1.0 - ty) +
           (high[0] * (1.0 - tx) + high[1] * tx) * ty;
}

double DomePortal::sumOf(const float low[2], const float high[2]) const {
    return std::max(sumTo(high[0], high[1]) - sumTo(low[0], high[1]) - sumTo(high[0], low[1]) +
                        sumTo(low[0], low[1]),
                    0.0);
}

double DomePortal::cell(int x, int y) const {
    const double* low = &_sums[size_t(y) * (size + 1) + size_t(x)];
    const double* high = low + size + 1;
    return std::max(high[1] - high[0] - low[1] + low[0], 0.0);
}

DomePortal::Window DomePortal::window(const vec3& point) const {
    Window window;
    const vec3 v = _center - point;
    const float away = glm::dot(v, _z);
    if (!(away > 1e-4f * (_half[0] + _half[1]))) return window; // beside it or behind it
    const float at[2] = {glm::dot(v, _x), glm::dot(v, _y)};
    for (int k = 0; k < 2; ++k) {
        window.low[k] = cellsOf((at[k] - _half[k]) / away);
        window.high[k] = cellsOf((at[k] + _half[k]) / away);
        if (!(window.high[k] > window.low[k])) return window;
    }
    window.worth = sumOf(window.low, window.high);
    // Rounding leaves something of an empty part of a bright map.
    if (!(window.worth > 1e-12 * _sums.back())) window.worth = 0.0;
    return window;
}

vec3 DomePortal::sample(const Window& w, const vec2& u) const {
    // The column of cells, by all that is before it in the window; then the cell in the column.
    float at[2];
    float low[2] = {w.low[0], w.low[1]}, high[2] = {w.high[0], w.high[1]};
    for (int k = 0; k < 2; ++k) {
        const double total = sumOf(low, high), wanted = double(u[k]) * total;
        const float from = low[k];
        const auto before = [&](float edge) {
            float end[2] = {high[0], high[1]};
            end[k] = edge;
            return sumOf(low, end);
        };
        int first = int(low[k]), last = std::min(int(high[k]), size - 1);
        while (first < last) {
            const int middle = (first + last) / 2;
            if (before(float(middle + 1)) > wanted)
                last = middle;
            else
                first = middle + 1;
        }
        const float begin = std::max(from, float(first));
        const float end = std::min(high[k], float(first + 1));
        const double sum = before(begin), more = before(end) - sum;
        const float share = more > 0.0 ? float((wanted - sum) / more) : u[k];
        at[k] = begin + std::clamp(share, 0.0f, largestBelowOne) * (end - begin);
        low[k] = float(first);
        high[k] = float(first + 1);
    }
    const vec3 d = glm::normalize(vec3(tangentOf(at[0]), tangentOf(at[1]), 1.0f));
    return _x * d.x + _y * d.y + _z * d.z;
}

float DomePortal::pdf(const Window& w, const vec3& direction) const {
    const vec3 d(glm::dot(direction, _x), glm::dot(direction, _y), glm::dot(direction, _z));
    if (!(w.worth > 0.0) || !(d.z > 0.0f)) return 0.0f;
    const float x = cellsOf(d.x / d.z), y = cellsOf(d.y / d.z);
    if (!(x >= w.low[0] && x <= w.high[0] && y >= w.low[1] && y <= w.high[1])) return 0.0f;
    const int i = std::clamp(int(x), 0, size - 1), j = std::clamp(int(y), 0, size - 1);
    return float(cell(i, j) / w.worth) / (radiansPerCell * radiansPerCell * stretch(d));
}

bool DomePortals::sample(const vec3& point, vec2& u, vec3& direction) const {
    double sum = 0.0;
    for (const DomePortal& portal : _portals)
        sum += portal.window(point).worth;
    if (!(sum > 0.0)) return false;
    if (u.x < elsewhere) {
        u.x /= elsewhere;
        return false;
    }
    double at = double((u.x - elsewhere) / (1.0f - elsewhere)) * sum;
    const DomePortal* chosen = nullptr; // the last one that is seen, where rounding runs past it
    DomePortal::Window seen;
    float within = 0.0f;
    for (const DomePortal& portal : _portals) {
        const DomePortal::Window window = portal.window(point);
        if (!(window.worth > 0.0)) continue;
        chosen = &portal;
        seen = window;
        within = std::min(float(at / window.worth), largestBelowOne);
        if (at < window.worth) break;
        at -= window.worth;
    }
    direction = chosen->sample(seen, vec2(within, u.y));
    return true;
}

float DomePortals::pdf(const vec3& point, const vec3& direction, float own) const {
    double sum = 0.0, guided = 0.0;
    for (const DomePortal& portal : _portals) {
        const DomePortal::Window window = portal.window(point);
        sum += window.worth;
        guided += window.worth * double(portal.pdf(window, direction));
    }
    if (!(sum > 0.0)) return own;
    return elsewhere * own + (1.0f - elsewhere) * float(guided / sum);
}

} // namespace patina
