// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/curveValues.h"
#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/splitRibbons.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Takes the curves apart; those that cannot be drawn keep no segments.
CurveBatch takeApart(const Curves& curves, const PointSteps& points, Diagnostics& diagnostics) {
    CurveBatch batch;
    batch.basis = curves.basis;
    batch.wrap = curves.wrap;
    size_t point = 0, varying = 0, unused = 0;
    size_t tooShort = 0, truncated = 0, notFinite = 0;
    for (int authored : curves.curveVertexCounts) {
        const int count = std::max(authored, 0);
        // Nothing is made as large as a count claims to be.
        const bool fits = point + size_t(count) <= points.count();
        CurveLayout layout = curveLayout(count, curves.basis, curves.wrap, fits);
        batch.firstPoint.push_back(point);
        batch.firstVarying.push_back(varying);
        batch.firstShortVarying.push_back(batch.shortVarying);
        varying += size_t(varyingCount(layout, curves.wrap));
        batch.shortVarying += size_t(std::max(count - 4, 0) + 2);
        unused += layout.unused > 0;
        tooShort += layout.segments == 0;
        if (!fits) {
            truncated += layout.segments > 0;
            layout.segments = 0;
        }
        if (layout.segments > 0)
            for (int i = 0; i < count; ++i)
                if (points.isBad(point + size_t(i))) {
                    ++notFinite;
                    layout.segments = 0;
                    break;
                }
        point += size_t(count);
        batch.layouts.push_back(std::move(layout));
    }
    batch.counts.uniform = curves.curveVertexCounts.size();
    batch.counts.vertex = points.count();
    batch.counts.varying = batch.counts.faceVarying = varying;
    if (batch.wrap != CurveWrap::Pinned) batch.shortVarying = varying;

    const auto report = [&](size_t count, const char* input, const MessageMaker<1>& what) {
        if (count > 0) diagnostics.warn(curves.path, input, what(count));
    };
    report(tooShort, "curveVertexCounts", messages::curvesTooShort);
    report(unused, "curveVertexCounts", messages::curvePointsUnused);
    report(truncated, "curveVertexCounts", messages::curvesTruncated);
    report(notFinite, "points", messages::curvesNotFinite);
    if (point < points.count())
        diagnostics.warn(curves.path, "points", messages::pointsOfNoCurve(points.count() - point));
    return batch;
}

/// The authored primvar, or a constant.
CurveValues readOr(const Curves& curves, const char* name, std::vector<float> fallback,
                   const CurveBatch& batch, Diagnostics& diagnostics) {
    CurveValues values;
    const Primvar* primvar = curves.primvar(name);
    if (primvar && primvar->components != int(fallback.size())) {
        diagnostics.warn(curves.path, name, messages::wrongType);
        primvar = nullptr;
    }
    if (!primvar || !values.read(*primvar, batch, curves.path, diagnostics))
        values.setConstant(std::move(fallback));
    return values;
}

CurveValues readWidths(const Curves& curves, const CurveBatch& batch, Diagnostics& diagnostics) {
    CurveValues widths = readOr(curves, "widths", {1.0f}, batch, diagnostics);
    size_t negative = 0;
    for (float& width : widths.data())
        if (width < 0.0f) {
            width = 0.0f;
            ++negative;
        }
    if (negative > 0) diagnostics.warn(curves.path, "widths", messages::widthsNegative(negative));
    return widths;
}

/// Writes the control points of one curve after another.
class ControlPoints {
public:
    ControlPoints(const PointSteps& points, const CurveBatch& batch, const CurveValues& widths,
                  const CurveValues* normals, CurveSet& out)
        : _points(points), _batch(batch), _widths(widths), _normals(normals), _out(out) {
        out.controlPoints.resize(points.steps.size());
        if (normals) out.normals.resize(1);
    }

    void curve(size_t c, bool bezier) {
        const CurveLayout& layout = _batch.layouts[c];
        const uint32_t first = uint32_t(_out.controlPoints[0].size());
        for (int s = 0; s < layout.segments; ++s)
            _out.segments.push_back(first + uint32_t(s * (bezier ? 3 : layout.step)));
        if (!bezier) {
            for (int k = 0; k < int(layout.points.size()); ++k)
                point(c, k);
            return;
        }
        for (int s = 0; s < layout.segments; ++s)
            bezierSegment(c, s, s == 0 ? 0 : 1);
    }

private:
    vec3 position(size_t step, size_t c, int k) const {
        const CurveLayout::Point p = _batch.layouts[c].points[k];
        const auto& list = _points.steps[step];
        const vec3 a = list[_batch.firstPoint[c] + size_t(p.a)];
        return p.phantom() ? 2.0f * a - list[_batch.firstPoint[c] + size_t(p.b)] : a;
    }
    void point(size_t c, int k) {
        float width, normal[3];
        _widths.atPoint(_batch, c, k, &width);
        for (size_t step = 0; step < _points.steps.size(); ++step)
            _out.controlPoints[step].push_back(vec4(position(step, c, k), 0.5f * width));
        if (_normals) {
            _normals->atPoint(_batch, c, k, normal);
            addNormal(normal);
        }
    }
    void bezierSegment(size_t c, int s, int from) {
        float widths[4], normals[12];
        _widths.asBezier(_batch, c, s, widths);
        for (size_t step = 0; step < _points.steps.size(); ++step) {
            vec3 in[4] = {vec3(0), vec3(0), vec3(0), vec3(0)}, out[4];
            for (int k = 0; k < (_batch.basis == CurveBasis::Linear ? 2 : 4); ++k)
                in[k] = position(step, c, s * _batch.layouts[c].step + k);
            toBezier(_batch.basis, in, out);
            for (int k = from; k < 4; ++k)
                _out.controlPoints[step].push_back(vec4(out[k], std::max(0.5f * widths[k], 0.0f)));
        }
        if (_normals) {
            _normals->asBezier(_batch, c, s, normals);
            for (int k = from; k < 4; ++k)
                addNormal(normals + 3 * k);
        }
    }
    void addNormal(const float* n) {
        const vec3 v(n[0], n[1], n[2]);
        const float length = glm::length(v);
        _out.normals[0].push_back(length > 0.0f ? v / length : vec3(0, 0, 1));
    }

    const PointSteps& _points;
    const CurveBatch& _batch;
    const CurveValues& _widths;
    const CurveValues* _normals;
    CurveSet& _out;
};

/// Whether the phantom points of pinned curves would get a negative radius, which Embree cannot
/// have; the Bezier points of the same curve never do.
bool negativePhantom(const CurveBatch& batch, const CurveValues& widths) {
    if (batch.wrap != CurveWrap::Pinned || widths.isVarying()) return false;
    for (size_t c = 0; c < batch.layouts.size(); ++c) {
        const CurveLayout& layout = batch.layouts[c];
        if (layout.segments == 0) continue;
        for (int k : {0, int(layout.points.size()) - 1}) {
            float width;
            widths.atPoint(batch, c, k, &width);
            if (width < 0.0f) return true;
        }
    }
    return false;
}

/// Whether values on control points leave the line between the ends of any segment.
bool anyBends(const CurveValues& values, const CurveBatch& batch) {
    const int n = values.components();
    float value[4 * 16];
    for (size_t c = 0; c < batch.layouts.size(); ++c)
        for (int s = 0; s < batch.layouts[c].segments; ++s) {
            values.asBezier(batch, c, s, value);
            for (int i = 0; i < n; ++i) {
                const float a = value[i], b = value[3 * n + i], third = (b - a) / 3.0f;
                const float off = std::max(std::abs(value[n + i] - a - third),
                                           std::abs(value[2 * n + i] - b + third));
                if (off > 1e-5f * std::max(std::abs(a), std::abs(b))) return true;
            }
        }
    return false;
}

MeshAttribute makeAttribute(const Primvar& primvar, CurveValues& values, const CurveBatch& batch) {
    MeshAttribute out;
    out.name = primvar.name;
    out.components = values.components();
    if (values.interpolation() == Interpolation::Constant ||
        values.interpolation() == Interpolation::Uniform) {
        out.rate = values.interpolation() == Interpolation::Constant ? MeshAttribute::Rate::Constant
                                                                     : MeshAttribute::Rate::PerFace;
        out.data = std::move(values.data());
        return out;
    }
    const bool bends =
        batch.basis != CurveBasis::Linear && !values.isVarying() && anyBends(values, batch);
    out.rate = bends ? MeshAttribute::Rate::PerControl : MeshAttribute::Rate::PerCorner;
    float value[4 * 16];
    for (size_t c = 0; c < batch.layouts.size(); ++c)
        for (int s = 0; s < batch.layouts[c].segments; ++s) {
            if (bends)
                values.asBezier(batch, c, s, value);
            else
                for (int end = 0; end < 2; ++end)
                    values.atSegmentEnd(batch, c, s, end, value + end * out.components);
            out.data.insert(out.data.end(), value,
                            value + valuesOfSegment(out.rate) * out.components);
        }
    return out;
}

} // namespace

CurveSet buildCurves(const Curves& curves, const TessellationOptions& options,
                     Diagnostics& diagnostics) {
    const PointSteps points = resamplePoints(curves.points, curves.path, options, diagnostics);
    if (points.count() == 0 || curves.curveVertexCounts.empty())
        diagnostics.warn(curves.path, "points", messages::noCurves);
    const CurveBatch batch = takeApart(curves, points, diagnostics);
    const CurveValues widths = readWidths(curves, batch, diagnostics);
    CurveValues normals;
    const Primvar* authored = curves.primvar("normals");
    const bool ribbons = authored && authored->components == 3 &&
                         normals.read(*authored, batch, curves.path, diagnostics);
    const bool linear = curves.basis == CurveBasis::Linear;
    // Embree has no linear ribbons, values that are linear along cubic segments only stand on
    // control points of the Bezier basis, and it is the one that ribbons are split in.
    const bool bezier =
        ribbons || (!linear && (widths.isVarying() || negativePhantom(batch, widths)));

    CurveSet out;
    out.basis = bezier ? CurveBasis::Bezier : curves.basis;
    const std::vector<uint16_t> subsetOf =
        subsetOfElements(curves, curves.curveVertexCounts.size(), diagnostics);
    ControlPoints writer(points, batch, widths, ribbons ? &normals : nullptr, out);
    for (size_t c = 0; c < batch.layouts.size(); ++c) {
        const int segments = batch.layouts[c].segments;
        if (segments == 0) continue;
        writer.curve(c, bezier);
        for (int s = 0; s < segments; ++s) {
            out.segmentCurve.push_back(int(c));
            out.segmentU.push_back(vec2(s, s + 1) / float(segments));
            if (!subsetOf.empty()) out.segmentSubset.push_back(subsetOf[c]);
        }
    }
    for (const Primvar& primvar : curves.primvars) {
        CurveValues values;
        if (primvar.name != "widths" && primvar.name != "normals" &&
            values.read(primvar, batch, curves.path, diagnostics))
            out.attributes.push_back(makeAttribute(primvar, values, batch));
    }
    if (out.segments.empty()) return out;
    if (ribbons) splitRibbons(out);
    out.boundsMin = vec3(INFINITY);
    out.boundsMax = vec3(-INFINITY);
    for (const auto& step : out.controlPoints)
        for (const vec4& p : step) {
            out.boundsMin = glm::min(out.boundsMin, vec3(p) - p.w);
            out.boundsMax = glm::max(out.boundsMax, vec3(p) + p.w);
        }
    return out;
}

} // namespace patina
