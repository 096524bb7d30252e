// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/bezierBatch.h"
#include "hdDelegate/geometry/primvarExpand.h"

namespace patina {

namespace {

struct Authored {
    size_t curve, first;
    int points;
};

/// Curves of at least two points that are there.
std::vector<Authored> usable(const HermiteCurves& curves, size_t points, Diagnostics& diagnostics) {
    std::vector<Authored> list;
    size_t first = 0, tooShort = 0, truncated = 0;
    for (size_t c = 0; c < curves.curveVertexCounts.size(); ++c) {
        const int count = std::max(curves.curveVertexCounts[c], 0);
        if (count < 2)
            ++tooShort;
        else if (first + size_t(count) > points)
            ++truncated;
        else
            list.push_back({c, first, count});
        first += size_t(count);
    }
    const auto report = [&](size_t count, const MessageMaker<1>& what) {
        if (count > 0) diagnostics.warn(curves.path, "curveVertexCounts", what(count));
    };
    report(tooShort, messages::hermiteTooShort);
    report(truncated, messages::curvesTruncated);
    return list;
}

vec3 straight(const std::vector<vec3>& points, const Authored& curve, int i) {
    const size_t at = curve.first + size_t(i);
    const size_t before = i > 0 ? at - 1 : at, after = i + 1 < curve.points ? at + 1 : at;
    return (points[after] - points[before]) / float(after - before);
}

} // namespace

std::shared_ptr<const Curves> toBezier(const HermiteCurves& curves, Diagnostics& diagnostics) {
    BezierBatch batch(curves);
    size_t points = curves.points.empty() ? 0 : curves.points.first().size();
    for (const auto& sample : curves.points.values)
        points = std::min(points, sample.size());
    const std::vector<Authored> list = usable(curves, points, diagnostics);
    for (const Authored& curve : list) {
        batch.begin(curve.curve);
        batch.end(3 * (curve.points - 1) + 1);
    }
    bool fits = true;
    for (size_t s = 0; s < curves.points.values.size(); ++s) {
        const std::vector<vec3>& p = curves.points.values[s];
        const size_t sample = std::min(s, std::max<size_t>(curves.tangents.values.size(), 1) - 1);
        const std::vector<vec3>* tangents =
            curves.tangents.empty() ? nullptr : &curves.tangents.values[sample];
        if (!tangents || tangents->size() != p.size()) {
            tangents = nullptr;
            fits = false;
        }
        std::vector<vec3>& out = batch.out().points.values[s];
        for (const Authored& curve : list) {
            const auto tangent = [&](int i) {
                return tangents ? (*tangents)[curve.first + size_t(i)] : straight(p, curve, i);
            };
            out.push_back(p[curve.first]);
            for (int i = 1; i < curve.points; ++i) {
                const vec3 a = p[curve.first + size_t(i) - 1], b = p[curve.first + size_t(i)];
                out.push_back(a + tangent(i - 1) / 3.0f);
                out.push_back(b - tangent(i) / 3.0f);
                out.push_back(b);
            }
        }
    }
    if (!fits) diagnostics.warn(curves.path, "tangents", messages::tangentsDiffer);
    ElementCounts counts;
    counts.uniform = curves.curveVertexCounts.size();
    counts.varying = counts.vertex = counts.faceVarying =
        curves.points.empty() ? 0 : curves.points.first().size();
    for (const Primvar& primvar : curves.primvars) {
        std::vector<float> values;
        if (!expandPrimvar(primvar, counts, curves.path, diagnostics, values)) continue;
        if (primvar.interpolation == Interpolation::Constant ||
            primvar.interpolation == Interpolation::Uniform) {
            batch.addPlain(primvar, std::move(values));
            continue;
        }
        const size_t n = size_t(primvar.components);
        std::vector<float> kept;
        for (const Authored& curve : list)
            kept.insert(kept.end(), values.begin() + long(curve.first * n),
                        values.begin() + long((curve.first + size_t(curve.points)) * n));
        batch.add(primvar, Interpolation::Varying, std::move(kept));
    }
    return batch.finish(curves.curveVertexCounts.size());
}

} // namespace patina
