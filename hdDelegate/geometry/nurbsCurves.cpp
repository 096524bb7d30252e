// SPDX-License-Identifier: Apache-2.0
// NURBS curves as Bezier ones: between two knots a cubic with the ends and slopes of the curve.

#include "hdDelegate/geometry/bezierBatch.h"
#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/primvarExpand.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace patina {

namespace {

using dvec3 = glm::dvec3;

constexpr int maxPieces = 64;      // of a span that is no cubic
constexpr double tolerance = 1e-5; // of such a piece, of the size of the curve

/// Part of a span that becomes one Bezier segment.
struct Piece {
    NurbsBasis::Span span;
    double low, high;
};

/// One curve that can be drawn.
class Curve {
public:
    Curve(const NurbsDirection& direction, size_t first, const double* weights)
        : _basis(direction), _first(first), _weights(weights) {}

    /// @param points of the whole prim
    void chooseSegments(const std::vector<vec3>& points, int count) {
        dvec3 low(INFINITY), high(-INFINITY);
        for (int i = 0; i < count; ++i) {
            const dvec3 p(points[_first + size_t(i)]);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const double maximum = tolerance * glm::length(high - low);
        for (const NurbsBasis::Span& span : _basis.spans()) {
            int n = 1;
            if (_weights || _basis.order() > 4)
                while (n < maxPieces && !within(span, n, points, maximum))
                    n *= 2;
            for (int i = 0; i < n; ++i)
                _pieces.push_back({span, at(span, i, n), at(span, i + 1, n)});
        }
    }

    int bezierPoints() const { return 3 * int(_pieces.size()) + 1; }

    /// Bezier values of what has N numbers per control point.
    /// @param values of the whole prim
    template <class In, class Out>
    void vertex(const In* values, size_t n, std::vector<Out>& out) const {
        std::vector<double> a(n), b(n), slopeA(n), slopeB(n);
        for (const Piece& piece : _pieces) {
            const double third = (piece.high - piece.low) / 3.0;
            combine(piece.span, piece.low, values, n, a, slopeA);
            combine(piece.span, piece.high, values, n, b, slopeB);
            const auto add = [&](const std::vector<double>& base, const std::vector<double>& slope,
                                 double step) {
                for (size_t k = 0; k < n; ++k)
                    out.push_back(Out(base[k] + step * slope[k]));
            };
            if (&piece == &_pieces.front()) add(a, slopeA, 0.0);
            add(a, slopeA, third);
            add(b, slopeB, -third);
            add(b, slopeB, 0.0);
        }
    }

    /// Values at the ends of the Bezier segments of what has one at each knot.
    /// @param values of this curve
    void varying(const float* values, size_t n, std::vector<float>& out) const {
        const auto add = [&](const Piece& piece, double t) {
            const float x = float(_basis.along(piece.span, t));
            const float* a = values + size_t(_basis.segment(piece.span)) * n;
            for (size_t k = 0; k < n; ++k)
                out.push_back((1.0f - x) * a[k] + x * a[n + k]);
        };
        for (const Piece& piece : _pieces)
            add(piece, piece.low);
        add(_pieces.back(), _pieces.back().high);
    }

private:
    static double at(const NurbsBasis::Span& span, int i, int n) {
        return i == n ? span.high : span.low + (span.high - span.low) * i / n;
    }

    template <class In> void combine(const NurbsBasis::Span& span, double t, const In* values,
                                     size_t n, std::vector<double>& value,
                                     std::vector<double>& slope) const {
        double basis[highestOrder], slopes[highestOrder];
        _basis.evaluate(span, t, basis, slopes);
        const size_t first = _first + size_t(_basis.segment(span));
        if (_weights) {
            double sum = 0.0, sumSlopes = 0.0;
            for (int i = 0; i < _basis.order(); ++i) {
                basis[i] *= _weights[first + size_t(i)];
                slopes[i] *= _weights[first + size_t(i)];
                sum += basis[i];
                sumSlopes += slopes[i];
            }
            for (int i = 0; i < _basis.order(); ++i) {
                basis[i] /= sum;
                slopes[i] = (slopes[i] - basis[i] * sumSlopes) / sum;
            }
        }
        std::fill(value.begin(), value.end(), 0.0);
        std::fill(slope.begin(), slope.end(), 0.0);
        for (int i = 0; i < _basis.order(); ++i)
            for (size_t k = 0; k < n; ++k) {
                const double v = double(values[(first + size_t(i)) * n + k]);
                value[k] += basis[i] * v;
                slope[k] += slopes[i] * v;
            }
    }

    /// Whether n cubics are close enough to a span.
    bool within(const NurbsBasis::Span& span, int n, const std::vector<vec3>& points,
                double maximum) const {
        std::vector<double> a(3), b(3), slopeA(3), slopeB(3), p(3), slope(3);
        const float* values = &points[0].x;
        for (int i = 0; i < n; ++i) {
            const double low = at(span, i, n), high = at(span, i + 1, n), h = high - low;
            combine(span, low, values, 3, a, slopeA);
            combine(span, high, values, 3, b, slopeB);
            for (const double x : {0.25, 0.5, 0.75}) {
                combine(span, low + h * x, values, 3, p, slope);
                const double y = 1.0 - x;
                double error = 0.0;
                for (size_t k = 0; k < 3; ++k) {
                    const double cubic = y * y * (1.0 + 2.0 * x) * a[k] +
                                         x * y * y * h * slopeA[k] +
                                         x * x * (1.0 + 2.0 * y) * b[k] - x * x * y * h * slopeB[k];
                    error += (cubic - p[k]) * (cubic - p[k]);
                }
                if (!(std::sqrt(error) <= maximum)) return !std::isfinite(error);
            }
        }
        return true;
    }

    NurbsBasis _basis;
    size_t _first; ///< point of the prim
    const double* _weights;
    std::vector<Piece> _pieces;
};

/// All curves of a prim; directions stay where they are, since bases refer to them.
struct Authored {
    std::vector<NurbsDirection> directions;
    std::vector<size_t> firstPoint, firstVarying;
    size_t varying = 0;
    std::vector<uint8_t> usable;
};

Authored takeApart(const NurbsCurves& curves, size_t points, Diagnostics& diagnostics) {
    Authored all;
    std::map<std::pair<std::string, std::string>, int> problems;
    const size_t count = curves.curveVertexCounts.size();
    const bool ranges = curves.ranges.size() == 2 * count;
    if (!ranges && !curves.ranges.empty())
        diagnostics.warn(curves.path, "ranges", messages::rangesDiffer);
    size_t point = 0, knot = 0;
    for (size_t c = 0; c < count; ++c) {
        NurbsDirection d;
        d.vertexCount = std::max(curves.curveVertexCounts[c], 0);
        d.order = c < curves.orders.size() ? curves.orders[c] : 0;
        const size_t knots = size_t(d.vertexCount) + size_t(std::max(d.order, 0));
        if (knot < curves.knots.size()) {
            const size_t end = std::min(knot + knots, curves.knots.size());
            d.knots.assign(curves.knots.begin() + long(knot), curves.knots.begin() + long(end));
        }
        if (ranges) {
            d.low = curves.ranges[2 * c];
            d.high = curves.ranges[2 * c + 1];
        }
        if (curves.knots.empty()) fillKnots(d);
        NurbsBasis::Problem problem = NurbsBasis::problem(d, "");
        if (!problem && point + size_t(d.vertexCount) > points)
            problem = {"curveVertexCounts", "go beyond the end of the points"};
        if (problem) ++problems[{problem.input, problem.message}];
        all.usable.push_back(!problem);
        all.firstPoint.push_back(point);
        all.firstVarying.push_back(all.varying);
        all.varying += d.order > 0 ? size_t(std::max(d.vertexCount - d.order + 2, 0)) : 0;
        point += size_t(d.vertexCount);
        knot += knots;
        all.directions.push_back(std::move(d));
    }
    for (const auto& item : problems)
        diagnostics.warn(curves.path, item.first.first,
                         messages::nurbsNotDrawn(item.first.second, item.second));
    return all;
}

} // namespace

std::shared_ptr<const Curves> toBezier(const NurbsCurves& curves, Diagnostics& diagnostics) {
    if (curves.orders.empty() && !curves.curveVertexCounts.empty()) {
        diagnostics.warn(curves.path, "order", messages::orderMissing);
        auto lines = std::make_shared<Curves>(curves);
        lines->basis = CurveBasis::Linear;
        lines->wrap = CurveWrap::Nonperiodic;
        return lines;
    }
    BezierBatch batch(curves);
    size_t points = curves.points.empty() ? 0 : curves.points.first().size();
    for (const auto& sample : curves.points.values)
        points = std::min(points, sample.size());
    const Authored authored = takeApart(curves, points, diagnostics);
    const std::vector<double> weights =
        usableWeights(curves.weights, curves.points.empty() ? 0 : curves.points.first().size(),
                      curves.path, diagnostics);
    std::vector<Curve> list;
    std::vector<size_t> numbers;
    for (size_t c = 0; c < authored.directions.size(); ++c) {
        if (!authored.usable[c]) continue;
        const NurbsDirection& direction = authored.directions[c];
        Curve curve(direction, authored.firstPoint[c], weights.empty() ? nullptr : weights.data());
        curve.chooseSegments(curves.points.first(), direction.vertexCount);
        batch.begin(c);
        batch.end(curve.bezierPoints());
        numbers.push_back(c);
        list.push_back(std::move(curve));
    }
    for (size_t s = 0; s < curves.points.values.size(); ++s) {
        std::vector<float> out;
        for (const Curve& curve : list)
            curve.vertex(&curves.points.values[s][0].x, 3, out);
        for (size_t i = 0; i + 2 < out.size(); i += 3)
            batch.out().points.values[s].push_back(vec3(out[i], out[i + 1], out[i + 2]));
    }
    ElementCounts counts;
    counts.uniform = curves.curveVertexCounts.size();
    counts.varying = counts.faceVarying = authored.varying;
    counts.vertex = curves.points.empty() ? 0 : curves.points.first().size();
    for (const Primvar& primvar : curves.primvars) {
        std::vector<float> values, made;
        if (!expandPrimvar(primvar, counts, curves.path, diagnostics, values)) continue;
        const size_t n = size_t(primvar.components);
        switch (primvar.interpolation) {
        case Interpolation::Constant:
        case Interpolation::Uniform: batch.addPlain(primvar, std::move(values)); break;
        case Interpolation::Vertex:
            for (const Curve& curve : list)
                curve.vertex(values.data(), n, made);
            batch.add(primvar, Interpolation::Vertex, std::move(made));
            break;
        case Interpolation::Varying:
        case Interpolation::FaceVarying:
            for (size_t i = 0; i < list.size(); ++i)
                list[i].varying(&values[authored.firstVarying[numbers[i]] * n], n, made);
            batch.add(primvar, Interpolation::Varying, std::move(made));
            break;
        }
    }
    return batch.finish(curves.curveVertexCounts.size());
}

} // namespace patina
