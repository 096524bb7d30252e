// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/surfaceSpace.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace patina {

namespace {

/// Position of step `step` of `count` among `size` uniform samples: index and fraction.
std::pair<size_t, float> locate(int step, int count, size_t size) {
    if (size < 2 || count < 2) return {0, 0.0f};
    const float x = float(step) * float(size - 1) / float(count - 1);
    const size_t i = std::min(size_t(x), size - 2);
    return {i, x - float(i)};
}

template <class T>
std::vector<T> valuesAtStep(const std::vector<std::vector<T>>& steps, int step, int count) {
    const auto [i, f] = locate(step, count, steps.size());
    if (f == 0.0f) return steps[i];
    std::vector<T> result(steps[i].size());
    for (size_t k = 0; k < result.size(); ++k)
        result[k] = steps[i][k] * (1.0f - f) + steps[i + 1][k] * f;
    return result;
}

} // namespace

mat4 interpolate(const MotionTransform& transform, float time, const dvec3& origin) {
    const auto& times = transform.times;
    const auto value = [&](size_t i) { return seenFrom(origin, transform.values[i]); };
    if (transform.values.empty()) return seenFrom(origin, dmat4(1.0));
    if (transform.values.size() == 1 || time <= times.front()) return value(0);
    if (time >= times.back()) return value(transform.values.size() - 1);
    const size_t i = std::upper_bound(times.begin(), times.end(), time) - times.begin();
    const float f = (time - times[i - 1]) / (times[i] - times[i - 1]);
    return value(i - 1) * (1.0f - f) + value(i) * f;
}

std::vector<mat4> resample(const MotionTransform& transform, float open, float close,
                           const dvec3& origin) {
    size_t inside = 0;
    for (float t : transform.times)
        inside += t > open && t < close;
    const bool moves = transform.moves() && close > open;
    const int steps = moves ? int(std::min<size_t>(8, 2 + inside)) : 1;
    std::vector<mat4> result(steps);
    for (int i = 0; i < steps; ++i)
        result[i] = interpolate(
            transform, steps == 1 ? 0.0f : open + (close - open) * i / (steps - 1), origin);
    return result;
}

mat4 transformAtStep(const std::vector<mat4>& transforms, int step, int count) {
    const auto [i, f] = locate(step, count, transforms.size());
    return f == 0.0f ? transforms[i] : transforms[i] * (1.0f - f) + transforms[i + 1] * f;
}

PlacedShape atRest(const PrimShape& shape) {
    const CurveSet& curves = shape.curves;
    if (!curves.controlPoints.empty()) return {{}, curves.controlPoints, curves.normals};
    if (!shape.points.points.empty()) return {{}, shape.points.points, shape.points.normals};
    return {shape.mesh.positions, {}, shape.mesh.normals};
}

PlacedShape takeAtRest(PrimShape& shape) {
    CurveSet& curves = shape.curves;
    PointSet& points = shape.points;
    if (!curves.controlPoints.empty())
        return {{}, std::move(curves.controlPoints), std::move(curves.normals)};
    if (!points.points.empty()) return {{}, std::move(points.points), std::move(points.normals)};
    return {std::move(shape.mesh.positions), {}, std::move(shape.mesh.normals)};
}

PlacedShape takeMoments(PlacedShape& shape) {
    PlacedShape moments;
    const size_t steps = std::max(shape.positions.size(), shape.points.size());
    const auto cut = [&](auto& from, auto& to) {
        if (from.size() != steps || steps < 4) return;
        to.assign(std::make_move_iterator(from.end() - 3), std::make_move_iterator(from.end()));
        from.resize(steps - 3);
    };
    cut(shape.positions, moments.positions);
    cut(shape.points, moments.points);
    cut(shape.normals, moments.normals);
    return moments;
}

void bake(Surface& surface, const std::vector<mat4>& transforms) {
    const auto bakePositions = [&](auto& steps, const auto& apply) {
        if (steps.empty()) return;
        const int count = int(std::max(steps.size(), transforms.size()));
        std::remove_reference_t<decltype(steps)> result(count);
        for (int s = 0; s < count; ++s) {
            result[s] = valuesAtStep(steps, s, count);
            const mat4 m = transformAtStep(transforms, s, count);
            for (auto& value : result[s])
                value = apply(m, value);
            result[s].reserve(result[s].size() + 1); // Embree reads 16 bytes of the last element
        }
        steps = std::move(result);
    };
    const auto point = [](const mat4& m, const vec3& p) { return vec3(m * vec4(p, 1.0f)); };
    const auto sphere = [](const mat4& m, const vec4& p) {
        const float scale = std::cbrt(std::abs(glm::determinant(mat3(m))));
        return vec4(vec3(m * vec4(vec3(p), 1.0f)), p.w * scale);
    };
    const auto normal = [](const mat4& m, const vec3& n) {
        const vec3 t = glm::transpose(glm::inverse(mat3(m))) * n;
        const float length = glm::length(t);
        return length > 0.0f ? t / length : vec3(0, 0, 1);
    };
    bakePositions(surface.placed.positions, point);
    bakePositions(surface.placed.points, sphere);
    bakePositions(surface.placed.normals, normal);
    surface.flipNormals = glm::determinant(mat3(transforms[0])) < 0.0f;
    surface.groupToObject = glm::inverse(transforms[transforms.size() / 2]);
}

} // namespace patina
