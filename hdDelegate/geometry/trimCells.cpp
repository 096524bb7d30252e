// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/trimCells.h"

#include "hdDelegate/geometry/triangulate.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace patina {

namespace {

constexpr int mostRounds = 8; // of cutting pieces where they meet

double cross(const dvec2& a, const dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

struct Before {
    bool operator()(const dvec2& a, const dvec2& b) const {
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    }
};

/// Part of a loop within one cell.
struct Piece {
    int row, column;
    dvec2 a, b;
};

/// Counterclockwise from the direction of x.
bool turnsBefore(const dvec2& a, const dvec2& b) {
    const auto lower = [](const dvec2& d) { return d.y < 0.0 || (d.y == 0.0 && d.x < 0.0); };
    return lower(a) != lower(b) ? lower(b) : cross(a, b) > 0.0;
}

/// The faces between lines that meet only at their ends.
class Faces {
public:
    /// A second line between the same ends takes the first away: nothing lies between them.
    void line(const dvec2& a, const dvec2& b) {
        if (a == b) return;
        const size_t i = node(a), j = node(b);
        if (_next[i].erase(j)) {
            _next[j].erase(i);
        } else {
            _next[i].insert(j);
            _next[j].insert(i);
        }
    }

    /// @param use (corners, counterclockwise) of each face that is bounded
    template <class Use> void each(const Use& use) const {
        std::vector<std::vector<size_t>> around(_points.size());
        for (size_t i = 0; i < _points.size(); ++i) {
            around[i].assign(_next[i].begin(), _next[i].end());
            std::sort(around[i].begin(), around[i].end(), [&](size_t a, size_t b) {
                return turnsBefore(_points[a] - _points[i], _points[b] - _points[i]);
            });
        }
        std::set<std::pair<size_t, size_t>> walked;
        std::vector<dvec2> corners;
        for (size_t first = 0; first < _points.size(); ++first)
            for (const size_t second : around[first]) {
                corners.clear();
                double area = 0.0;
                // The face on the left goes on at the next line clockwise from the way back.
                for (size_t a = first, b = second; walked.insert({a, b}).second;) {
                    corners.push_back(_points[a]);
                    area += cross(_points[a] - _points[first], _points[b] - _points[first]);
                    const std::vector<size_t>& ways = around[b];
                    auto back = std::find(ways.begin(), ways.end(), a);
                    if (back == ways.begin()) back = ways.end();
                    a = b;
                    b = *--back;
                }
                if (area > 0.0) use(corners);
            }
    }

private:
    size_t node(const dvec2& p) {
        const auto found = _nodes.emplace(p, _points.size());
        if (found.second) {
            _points.push_back(p);
            _next.emplace_back();
        }
        return found.first->second;
    }

    std::map<dvec2, size_t, Before> _nodes;
    std::vector<dvec2> _points;
    std::vector<std::set<size_t>> _next;
};

class Trimmer {
public:
    Trimmer(const std::vector<double>& x, const std::vector<double>& y) : _x(x), _y(y) {}

    void addLoop(const std::vector<dvec2>& loop) {
        std::vector<dvec2> byX, byY;
        for (size_t i = 0; i < loop.size(); ++i) {
            byX = {loop[i]};
            split(_x, 0, loop[(i + 1) % loop.size()], byX);
            for (size_t k = 1; k < byX.size(); ++k) {
                byY = {byX[k - 1]};
                split(_y, 1, byX[k], byY);
                for (size_t m = 1; m < byY.size(); ++m)
                    addPiece(byY[m - 1], byY[m]);
            }
        }
    }

    void cut(bool keepInside, const std::function<void(const TrimmedCell&)>& add) {
        const auto order = [](const Piece& a, const Piece& b) {
            return a.row != b.row ? a.row < b.row : a.column < b.column;
        };
        std::sort(_pieces.begin(), _pieces.end(), order);
        // What is cut moves to whole steps, and may then meet others anew.
        for (int round = 0; round < mostRounds && cutWhereTheyMeet(); ++round) {
        }
        for (const Piece& piece : _pieces)
            for (const dvec2& p : {piece.a, piece.b}) {
                _onX[p.x].insert(p.y);
                _onY[p.y].insert(p.x);
            }
        size_t begin = 0;
        for (int row = 0; row + 1 < int(_y.size()); ++row) {
            size_t end = begin;
            while (end < _pieces.size() && _pieces[end].row == row)
                ++end;
            const Piece *first = _pieces.data() + begin, *last = _pieces.data() + end;
            const auto kept = [&](const dvec2& p) {
                bool inside = false;
                for (const Piece* s = first; s < last; ++s)
                    if ((s->a.y <= p.y) != (s->b.y <= p.y) &&
                        s->a.x + (p.y - s->a.y) / (s->b.y - s->a.y) * (s->b.x - s->a.x) < p.x)
                        inside = !inside;
                return inside == keepInside;
            };
            const Piece* own = first;
            for (int column = 0; column + 1 < int(_x.size()); ++column) {
                const Piece* ownEnd = own;
                while (ownEnd < last && ownEnd->column == column)
                    ++ownEnd;
                cutCell(column, row, own, ownEnd, kept, add);
                own = ownEnd;
            }
            begin = end;
        }
    }

private:
    /// The cell that a number lies in, or the one beside the grid.
    static int cellOf(const std::vector<double>& lines, double at) {
        const auto above = std::upper_bound(lines.begin(), lines.end(), at);
        return std::clamp(int(above - lines.begin()) - 1, 0, int(lines.size()) - 2);
    }

    /// Goes on to a point, with a stop on each line.
    static void split(const std::vector<double>& lines, int axis, const dvec2& to,
                      std::vector<dvec2>& points) {
        const dvec2 from = points.back();
        const double low = std::min(from[axis], to[axis]), high = std::max(from[axis], to[axis]);
        const auto first = std::upper_bound(lines.begin(), lines.end(), low);
        for (auto line = first; line < lines.end() && *line < high; ++line) {
            const double share = (*line - from[axis]) / (to[axis] - from[axis]);
            dvec2 stop(*line);
            stop[1 - axis] = std::round(from[1 - axis] + share * (to[1 - axis] - from[1 - axis]));
            points.push_back(stop);
        }
        if (from[axis] > to[axis]) std::reverse(points.begin() + 1, points.end());
        points.push_back(to);
    }

    /// What lies beside the grid goes along its outline instead.
    void addPiece(dvec2 a, dvec2 b) {
        const dvec2 low(_x.front(), _y.front()), high(_x.back(), _y.back());
        a = glm::clamp(a, low, high);
        b = glm::clamp(b, low, high);
        if (a == b) return;
        const dvec2 middle = 0.5 * (a + b);
        _pieces.push_back({cellOf(_y, middle.y), cellOf(_x, middle.x), a, b});
    }

    /// Cuts pieces where they meet others of their cell. @returns whether any do
    bool cutWhereTheyMeet() {
        std::vector<Piece> out;
        for (size_t begin = 0, end; begin < _pieces.size(); begin = end) {
            end = begin;
            while (end < _pieces.size() && _pieces[end].row == _pieces[begin].row &&
                   _pieces[end].column == _pieces[begin].column)
                ++end;
            std::vector<std::vector<dvec2>> stops(end - begin);
            for (size_t i = begin; i < end; ++i)
                for (size_t j = i + 1; j < end; ++j)
                    meet(_pieces[i], _pieces[j], stops[i - begin], stops[j - begin]);
            for (size_t i = begin; i < end; ++i) {
                Piece piece = _pieces[i];
                const dvec2 from = piece.a, way = piece.b - piece.a;
                std::vector<dvec2>& points = stops[i - begin];
                std::sort(points.begin(), points.end(), [&](const dvec2& a, const dvec2& b) {
                    return glm::dot(a - from, way) < glm::dot(b - from, way);
                });
                points.push_back(piece.b);
                for (const dvec2& p : points) {
                    piece.b = p;
                    if (piece.a != piece.b) out.push_back(piece);
                    piece.a = p;
                }
            }
        }
        const bool any = out.size() > _pieces.size();
        _pieces = std::move(out);
        return any;
    }

    static void meet(const Piece& p, const Piece& q, std::vector<dvec2>& onP,
                     std::vector<dvec2>& onQ) {
        if (glm::any(glm::greaterThan(glm::min(p.a, p.b), glm::max(q.a, q.b))) ||
            glm::any(glm::greaterThan(glm::min(q.a, q.b), glm::max(p.a, p.b))))
            return;
        const dvec2 d = p.b - p.a, e = q.b - q.a;
        // On which side of each piece the other's ends are; products of whole numbers are exact.
        const double qa = cross(d, q.a - p.a), qb = cross(d, q.b - p.a);
        const double pa = cross(e, p.a - q.a), pb = cross(e, p.b - q.a);
        const auto touches = [](double side, const dvec2& end, const Piece& other) {
            return side == 0.0 && end != other.a && end != other.b &&
                   glm::all(glm::lessThanEqual(glm::min(other.a, other.b), end)) &&
                   glm::all(glm::lessThanEqual(end, glm::max(other.a, other.b)));
        };
        if (touches(qa, q.a, p)) onP.push_back(q.a);
        if (touches(qb, q.b, p)) onP.push_back(q.b);
        if (touches(pa, p.a, q)) onQ.push_back(p.a);
        if (touches(pb, p.b, q)) onQ.push_back(p.b);
        if (!((qa < 0.0 && qb > 0.0) || (qa > 0.0 && qb < 0.0)) ||
            !((pa < 0.0 && pb > 0.0) || (pa > 0.0 && pb < 0.0)))
            return;
        const dvec2 at = glm::round(p.a + pa / (pa - pb) * d);
        onP.push_back(at);
        onQ.push_back(at);
    }

    template <class Kept> void cutCell(int column, int row, const Piece* begin, const Piece* end,
                                       const Kept& kept,
                                       const std::function<void(const TrimmedCell&)>& add) const {
        const dvec2 low(_x[size_t(column)], _y[size_t(row)]);
        const dvec2 high(_x[size_t(column) + 1], _y[size_t(row) + 1]);
        if (low.x == high.x || low.y == high.y) return;
        TrimmedCell cell{column, row, {}, {}};
        std::vector<dvec2>& corners = cell.corners;
        // The outline, with the points that loops have on it.
        const auto side = [&](const std::map<double, std::set<double>>& on, int axis, double line,
                              const dvec2& from, const dvec2& to) {
            corners.push_back(from);
            const auto found = on.find(line);
            if (found == on.end()) return;
            const size_t first = corners.size();
            const double a = std::min(from[axis], to[axis]), b = std::max(from[axis], to[axis]);
            for (auto at = found->second.upper_bound(a); at != found->second.end() && *at < b; ++at)
                corners.push_back(axis == 0 ? dvec2(*at, line) : dvec2(line, *at));
            if (from[axis] > to[axis]) std::reverse(corners.begin() + long(first), corners.end());
        };
        side(_onY, 0, low.y, low, dvec2(high.x, low.y));
        side(_onX, 1, high.x, dvec2(high.x, low.y), high);
        side(_onY, 0, high.y, high, dvec2(low.x, high.y));
        side(_onX, 1, low.x, dvec2(low.x, high.y), low);
        if (begin == end && corners.size() == 4) {
            if (kept(0.5 * (low + high))) add(cell);
            return;
        }
        Faces faces;
        for (size_t i = 0; i < corners.size(); ++i)
            faces.line(corners[i], corners[(i + 1) % corners.size()]);
        for (const Piece* piece = begin; piece < end; ++piece) {
            const dvec2 &a = piece->a, &b = piece->b;
            if ((a.x == b.x && (a.x == low.x || a.x == high.x)) ||
                (a.y == b.y && (a.y == low.y || a.y == high.y)))
                continue; // on the outline
            faces.line(a, b);
        }
        faces.each([&](const std::vector<dvec2>& face) {
            corners = face;
            cell.triangles.clear();
            clipEars(corners, cell.triangles);
            double largest = 0.0;
            dvec2 middle(0.0);
            for (const uvec3& t : cell.triangles) {
                const dvec2 &a = corners[t.x], &b = corners[t.y], &c = corners[t.z];
                const double area = cross(b - a, c - a);
                if (!(area > largest)) continue;
                largest = area;
                middle = (a + b + c) / 3.0;
            }
            if (largest > 0.0 && kept(middle)) add(cell);
        });
    }

    const std::vector<double>&_x, &_y;
    std::vector<Piece> _pieces;
    std::map<double, std::set<double>> _onX, _onY; ///< points of pieces by each coordinate
};

} // namespace

void trimCells(const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<std::vector<dvec2>>& loops, bool keepInside,
               const std::function<void(const TrimmedCell&)>& add) {
    Trimmer trimmer(x, y);
    for (const std::vector<dvec2>& loop : loops)
        trimmer.addLoop(loop);
    trimmer.cut(keepInside, add);
}

} // namespace patina
