// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/trimLoops.h"

#include "hdDelegate/geometry/nurbs.h"
#include "hdDelegate/geometry/trimCells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace patina {

namespace {

constexpr int maxPieces = 64;                    // of a span
constexpr double widestGap = 1e-3 * trimSteps;   // between one curve of a loop and the next
constexpr double farthest = 65536.0 * trimSteps; // from the patch

class Curve {
public:
    Curve(const NurbsDirection& direction, const double* points)
        : _basis(direction), _points(points) {}

    void flatten(const TrimOptions& options, int most, std::vector<dvec2>& out) const {
        const auto add = [&](const NurbsBasis::Span& span, double t) {
            const dvec2 share = (at(span, t) - options.low) / (options.high - options.low);
            out.push_back(glm::round(glm::clamp(share * trimSteps, -farthest, farthest)));
        };
        add(_basis.spans()[0], _basis.low());
        for (const NurbsBasis::Span& span : _basis.spans()) {
            int n = _basis.order() > 2 ? std::min(options.pieces, most) : 1;
            while (_basis.order() > 2 && n < most && longest(options, span, n) > options.longest)
                n *= 2;
            for (int i = 1; i <= n; ++i)
                add(span, along(span, i, n));
        }
    }

private:
    static double along(const NurbsBasis::Span& span, int i, int n) {
        return i == n ? span.high : span.low + (span.high - span.low) * i / n;
    }

    dvec2 at(const NurbsBasis::Span& span, double t) const {
        double values[highestOrder], slopes[highestOrder];
        _basis.evaluate(span, t, values, slopes);
        dvec3 sum(0.0);
        for (int i = 0; i < _basis.order(); ++i) {
            const double* p = _points + 3 * (_basis.segment(span) + i);
            sum += values[i] * dvec3(p[0], p[1], p[2]);
        }
        return dvec2(sum) / sum.z;
    }

    /// Longest of n pieces of a span, on the surface.
    double longest(const TrimOptions& options, const NurbsBasis::Span& span, int n) const {
        if (!(options.longest > 0.0)) return 0.0;
        double found = 0.0;
        dvec3 before(0.0);
        for (int i = 0; i <= n; ++i) {
            const dvec3 p =
                options.place(glm::clamp(at(span, along(span, i, n)), options.low, options.high));
            if (i > 0) found = std::max(found, glm::distance(p, before));
            before = p;
        }
        return found;
    }

    NurbsBasis _basis;
    const double* _points;
};

/// Goes through the curves of all loops.
class Reader {
public:
    Reader(const TrimCurves& trim, const TrimOptions& options) : _trim(trim), _options(options) {
        const double spans = std::accumulate(trim.vertexCounts.begin(), trim.vertexCounts.end(),
                                             1.0, [](double a, int b) { return a + std::abs(b); });
        _most = int(std::clamp(double(options.budget) / spans, 1.0, double(maxPieces)));
    }

    /// @param curves that the loop has
    NurbsBasis::Problem loop(int curves, std::vector<dvec2>& out) {
        NurbsBasis::Problem problem;
        if (curves < 1) problem = {"trimCurve:counts", "has loops without curves"};
        for (int i = 0; i < curves; ++i) {
            if (_curve == _trim.vertexCounts.size())
                return {"trimCurve:counts", "counts more curves than trimCurve:vertexCounts has"};
            std::vector<dvec2> points;
            const NurbsBasis::Problem found = curve(points);
            if (!problem) problem = found;
            if (problem) continue;
            if (!out.empty() && apart(out.back(), points.front())) problem = open;
            out.insert(out.end(), points.begin(), points.end());
        }
        if (!problem && apart(out.back(), out.front())) problem = open;
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return problem;
    }

private:
    static bool apart(const dvec2& a, const dvec2& b) {
        return glm::any(glm::greaterThan(glm::abs(a - b), dvec2(widestGap)));
    }

    NurbsBasis::Problem curve(std::vector<dvec2>& out) {
        NurbsDirection d;
        d.vertexCount = std::max(_trim.vertexCounts[_curve], 0);
        d.order = _curve < _trim.orders.size() ? _trim.orders[_curve] : 0;
        if (_trim.ranges.size() == 2 * _trim.vertexCounts.size()) {
            d.low = _trim.ranges[2 * _curve];
            d.high = _trim.ranges[2 * _curve + 1];
        }
        const size_t knots = size_t(d.vertexCount) + size_t(std::max(d.order, 0));
        const size_t first = std::min(_knot, _trim.knots.size());
        const size_t last = std::min(_knot + knots, _trim.knots.size());
        d.knots.assign(_trim.knots.begin() + long(first), _trim.knots.begin() + long(last));
        const size_t begin = 3 * _point, end = begin + 3 * size_t(d.vertexCount);
        ++_curve;
        _knot += knots;
        _point += size_t(d.vertexCount);
        NurbsBasis::Problem problem = NurbsBasis::problem(d, "");
        if (problem) {
            const std::string& input = problem.input;
            problem.input = "trimCurve:" + (input == "order"               ? "orders"
                                            : input == "curveVertexCounts" ? "vertexCounts"
                                                                           : input);
            return problem;
        }
        if (end > _trim.points.size())
            return {"trimCurve:points", "are fewer than trimCurve:vertexCounts says"};
        for (size_t i = begin; i < end; ++i)
            if (!std::isfinite(_trim.points[i]) || (i % 3 == 2 && !(_trim.points[i] > 0.0)))
                return {"trimCurve:points", "are not all finite, with a positive weight"};
        Curve(d, &_trim.points[begin]).flatten(_options, _most, out);
        return {};
    }

    const NurbsBasis::Problem open = {"trimCurve:points", "give loops that do not close"};
    const TrimCurves& _trim;
    const TrimOptions& _options;
    int _most = 1;
    size_t _curve = 0, _knot = 0, _point = 0;
};

} // namespace

std::vector<std::vector<dvec2>> trimLoops(const TrimCurves& trim, const std::string& prim,
                                          const TrimOptions& options, Diagnostics& diagnostics) {
    std::vector<std::vector<dvec2>> loops;
    std::map<std::pair<std::string, std::string>, int> problems;
    Reader reader(trim, options);
    for (const int curves : trim.counts) {
        std::vector<dvec2> loop;
        if (const NurbsBasis::Problem problem = reader.loop(curves, loop))
            ++problems[{problem.input, problem.message}];
        else if (loop.size() > 2)
            loops.push_back(std::move(loop));
    }
    for (const auto& item : problems)
        diagnostics.warn(prim, item.first.first,
                         messages::trimLoopsLeftOut(item.first.second, item.second));
    if (!trim.counts.empty() && !trim.ranges.empty() &&
        trim.ranges.size() != 2 * trim.vertexCounts.size())
        diagnostics.warn(prim, "trimCurve:ranges", messages::rangesDiffer);
    return loops;
}

} // namespace patina
