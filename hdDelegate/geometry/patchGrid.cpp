// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/patchGrid.h"

#include "hdDelegate/geometry/trimCells.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace patina {

namespace {

constexpr double poleStep = 1e-4;      // of a span: how far from a pole its normal is looked for
constexpr double pointsPerCell = 64.0; // of loops, roughly

/// A direction whose lines are cut by loops.
class Cutter {
public:
    explicit Cutter(PatchDirection& direction)
        : _direction(direction), _low(direction.basis.low()),
          _size(direction.basis.high() - direction.basis.low()) {}

    double step(size_t line) const {
        return std::round((_direction.lines[line].t - _low) / _size * trimSteps);
    }

    /// A further line, unless there is one already.
    void divide(double step) {
        auto& lines = _direction.lines;
        const double t = _low + step / trimSteps * _size;
        for (size_t i = 1; i < lines.size(); ++i)
            if (lines[i].joined && lines[i - 1].t < t && t < lines[i].t) {
                lines.insert(lines.begin() + long(i), _direction.line(lines[i].span, t));
                return;
            }
    }

    bool crosses(double low, double high) const {
        for (size_t i = 0; i < _direction.lines.size(); ++i)
            if (step(i) >= low && step(i) <= high) return true;
        return false;
    }

    /// When all lines are there: the steps at which cells end, the first line's before them.
    std::vector<double> ends() {
        std::vector<double> steps = {step(0)};
        for (size_t i = 1; i < _direction.lines.size(); ++i)
            if (_direction.lines[i].joined) {
                _ends.push_back(uint32_t(i));
                steps.push_back(step(i));
            }
        return steps;
    }

    int segment(int cell) const {
        return _direction.basis.segment(_direction.lines[_ends[size_t(cell)]].span);
    }

    /// The line of a vertex on the outline of a cell or in it.
    uint32_t line(int cell, double at) {
        const uint32_t end = _ends[size_t(cell)];
        if (at == step(end - 1)) return end - 1;
        if (at == step(end)) return end;
        const auto made = _made.emplace(std::make_pair(end, at), uint32_t(_direction.lines.size()));
        if (made.second) {
            const PatchLine& before = _direction.lines[end - 1];
            const PatchLine& after = _direction.lines[end];
            const double t = _low + at / trimSteps * _size;
            _direction.lines.push_back(
                _direction.line(after.span, std::clamp(t, before.t, after.t)));
        }
        return made.first->second;
    }

private:
    PatchDirection& _direction;
    double _low, _size;
    std::vector<uint32_t> _ends;
    std::map<std::pair<uint32_t, double>, uint32_t> _made;
};

/// Lines that keep the points of loops in any cell few.
void divideEvenly(Cutter& cutter, const std::vector<std::vector<dvec2>>& loops, int axis) {
    std::vector<double> steps;
    for (const auto& loop : loops)
        for (const dvec2& p : loop)
            steps.push_back(p[axis]);
    std::sort(steps.begin(), steps.end());
    const size_t parts = size_t(std::sqrt(double(steps.size()) / pointsPerCell));
    for (size_t i = 1; i < parts; ++i)
        cutter.divide(steps[steps.size() * i / parts]);
}

} // namespace

PatchLine PatchDirection::line(const NurbsBasis::Span& span, double t, bool joined) const {
    PatchLine made;
    made.span = span;
    made.t = t;
    made.joined = joined;
    made.values.resize(size_t(basis.order()));
    made.slopes.resize(size_t(basis.order()));
    basis.evaluate(span, t, made.values.data(), made.slopes.data());
    return made;
}

PatchLine PatchDirection::at(double t) const {
    const auto& spans = basis.spans();
    size_t s = 0;
    while (s + 1 < spans.size() && t >= spans[s].high)
        ++s;
    return line(spans[s], std::clamp(t, spans[s].low, spans[s].high));
}

PatchLine PatchDirection::inside(const PatchLine& edge) const {
    const double middle = 0.5 * (edge.span.low + edge.span.high);
    return line(edge.span, edge.t + poleStep * (middle - edge.t));
}

void PatchDirection::chooseLines(const std::vector<int>& pieces) {
    const auto& spans = basis.spans();
    for (size_t s = 0; s < spans.size(); ++s) {
        // One line ends a span and begins the next, unless there may be an edge.
        const bool own = s == 0 || basis.breaksBefore(spans[s]);
        for (int i = own ? 0 : 1; i <= pieces[s]; ++i) {
            const double x = double(i) / pieces[s];
            const double t = spans[s].low + (spans[s].high - spans[s].low) * x;
            lines.push_back(line(spans[s], t, i > 0));
        }
    }
}

PatchGrid wholeGrid(const PatchDirection& u, const PatchDirection& v) {
    PatchGrid grid;
    const uint32_t row = uint32_t(u.lines.size());
    for (uint32_t j = 0; j < v.lines.size(); ++j)
        for (uint32_t i = 0; i < row; ++i)
            grid.vertices.push_back({i, j});
    for (uint32_t j = 1; j < v.lines.size(); ++j) {
        if (!v.lines[j].joined) continue;
        const int segments = v.basis.segment(v.lines[j].span) * u.basis.segments();
        for (uint32_t i = 1; i < row; ++i) {
            if (!u.lines[i].joined) continue;
            const uint32_t d = j * row + i, b = d - row;
            grid.faces.push_back(
                {b - 1, b, d - 1, d, segments + u.basis.segment(u.lines[i].span), true});
        }
    }
    return grid;
}

PatchGrid trimmedGrid(PatchDirection& u, PatchDirection& v,
                      const std::vector<std::vector<dvec2>>& loops, bool keepInside) {
    Cutter cutU(u), cutV(v);
    divideEvenly(cutU, loops, 0);
    divideEvenly(cutV, loops, 1);
    for (const auto& loop : loops) {
        dvec2 low = loop[0], high = loop[0];
        for (const dvec2& p : loop) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        if (cutU.crosses(low.x, high.x) || cutV.crosses(low.y, high.y)) continue;
        const dvec2 middle = glm::round(0.5 * (low + high));
        if (u.lines.size() > v.lines.size()) // the fewer cells are cut
            cutU.divide(middle.x);
        else
            cutV.divide(middle.y);
    }
    const std::vector<double> x = cutU.ends(), y = cutV.ends();
    PatchGrid grid;
    std::unordered_map<uint64_t, uint32_t> numbers;
    trimCells(x, y, loops, keepInside, [&](const TrimmedCell& cell) {
        std::vector<uint32_t> corners;
        for (const dvec2& p : cell.corners) {
            const uint32_t i = cutU.line(cell.column, p.x), j = cutV.line(cell.row, p.y);
            const auto made =
                numbers.emplace(uint64_t(i) << 32 | j, uint32_t(grid.vertices.size()));
            if (made.second) grid.vertices.push_back({i, j});
            corners.push_back(made.first->second);
        }
        const int segment = cutV.segment(cell.row) * u.basis.segments() + cutU.segment(cell.column);
        if (cell.triangles.empty())
            grid.faces.push_back({corners[0], corners[1], corners[3], corners[2], segment, true});
        for (const uvec3& t : cell.triangles)
            grid.faces.push_back({corners[t.x], corners[t.y], corners[t.z], 0, segment, false});
    });
    return grid;
}

} // namespace patina
