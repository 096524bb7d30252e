// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/nurbs.h"

#include <algorithm>
#include <cmath>

namespace patina {

void fillKnots(NurbsDirection& d) {
    if (!d.knots.empty() || d.order < 1 || d.order > highestOrder || d.vertexCount < d.order)
        return;
    const bool ranged = d.low < d.high;
    const double low = ranged ? d.low : 0.0, high = ranged ? d.high : 1.0;
    const int segments = d.vertexCount - d.order + 1;
    d.knots.assign(size_t(d.order), low);
    for (int i = 1; i < segments; ++i)
        d.knots.push_back(low + (high - low) * i / segments);
    d.knots.insert(d.knots.end(), size_t(d.order), high);
}

NurbsBasis::Problem NurbsBasis::problem(const NurbsDirection& d, const std::string& prefix) {
    const auto named = [&](const char* upper, const char* lower) {
        return prefix.empty() ? std::string(lower) : prefix + upper;
    };
    const std::string order = std::to_string(d.order);
    if (d.order < 2 || d.order > highestOrder)
        return {named("Order", "order"),
                "is " + order + ", outside of 2 to " + std::to_string(highestOrder)};
    if (d.vertexCount < d.order)
        return {named("VertexCount", "curveVertexCounts"),
                std::to_string(d.vertexCount) + " are fewer than the order, " + order};
    const std::string knots = named("Knots", "knots");
    const size_t needed = size_t(d.vertexCount) + size_t(d.order);
    if (d.knots.size() != needed)
        return {knots, "has " + std::to_string(d.knots.size()) + " values where " +
                           std::to_string(needed) + " are needed"};
    for (size_t i = 0; i < needed; ++i) {
        if (!std::isfinite(d.knots[i])) return {knots, "has values that are not finite"};
        if (i > 0 && d.knots[i] < d.knots[i - 1]) return {knots, "has values that descend"};
    }
    if (NurbsBasis(d).spans().empty()) return {knots, "spans nothing"};
    return {};
}

NurbsBasis::NurbsBasis(const NurbsDirection& direction) : _direction(direction) {
    const std::vector<double>& knots = direction.knots;
    const int first = direction.order - 1, last = direction.vertexCount;
    double low = knots[size_t(first)], high = knots[size_t(last)];
    if (direction.low < direction.high) {
        low = std::max(low, direction.low);
        high = std::min(high, direction.high);
    }
    for (int k = first; k < last; ++k) {
        const double a = std::max(low, knots[size_t(k)]), b = std::min(high, knots[size_t(k) + 1]);
        if (a < b) _spans.push_back({k, a, b});
    }
}

double NurbsBasis::along(const Span& span, double t) const {
    const double a = _direction.knots[size_t(span.knot)],
                 b = _direction.knots[size_t(span.knot) + 1];
    return std::clamp((t - a) / (b - a), 0.0, 1.0);
}

bool NurbsBasis::breaksBefore(const Span& span) const {
    const std::vector<double>& knots = _direction.knots;
    if (span.low > knots[size_t(span.knot)]) return false; // begins within a segment
    int equal = 0;
    for (int k = span.knot; k >= 0 && knots[size_t(k)] == span.low; --k)
        ++equal;
    return equal >= order() - 1;
}

void NurbsBasis::evaluate(const Span& span, double t, double* values, double* slopes) const {
    // Cox and de Boor's recurrence; the last step but one is what derivatives are made of.
    const double* knots = &_direction.knots[size_t(span.knot)];
    const int degree = order() - 1;
    double lower[highestOrder] = {};
    values[0] = 1.0;
    for (int d = 1; d <= degree; ++d) {
        std::copy_n(values, d, lower);
        double carried = 0.0;
        for (int r = 0; r < d; ++r) {
            const double right = knots[r + 1] - t, left = t - knots[r + 1 - d];
            const double share = lower[r] / (right + left);
            values[r] = carried + right * share;
            carried = left * share;
        }
        values[d] = carried;
    }
    for (int r = 0; r <= degree; ++r) {
        const double rising = r > 0 ? lower[r - 1] / (knots[r] - knots[r - degree]) : 0.0;
        const double falling = r < degree ? lower[r] / (knots[r + 1] - knots[r + 1 - degree]) : 0.0;
        slopes[r] = double(degree) * (rising - falling);
    }
}

double NurbsBasis::longest(const Span& span, const vec3* points, size_t stride) const {
    const int degree = order() - 1, first = span.knot - degree;
    double fastest = 0.0;
    for (int i = first; i < first + degree; ++i) {
        const vec3 edge = points[size_t(i + 1) * stride] - points[size_t(i) * stride];
        const double knots =
            _direction.knots[size_t(i + 1 + degree)] - _direction.knots[size_t(i + 1)];
        fastest = std::max(fastest, double(degree) * double(glm::length(edge)) / knots);
    }
    return fastest * (span.high - span.low);
}

std::vector<double> usableWeights(const std::vector<double>& weights, size_t points,
                                  const std::string& prim, Diagnostics& diagnostics) {
    if (weights.empty()) return {};
    if (weights.size() != points) {
        diagnostics.warn(prim, "pointWeights", messages::weightsDiffer(weights.size(), points));
        return {};
    }
    std::vector<double> usable = weights;
    size_t bad = 0;
    for (double& w : usable)
        if (!(w > 0.0) || !std::isfinite(w)) {
            w = 1.0;
            ++bad;
        }
    if (bad > 0) diagnostics.warn(prim, "pointWeights", messages::weightsNotPositive(bad));
    return usable;
}

void setNurbsCage(Mesh& mesh) {
    mesh.scheme = SubdivisionScheme::CatmullClark;
    mesh.faceVertexCounts.clear();
    mesh.faceVertexIndices.clear();
    const int nu = mesh.patch->u.vertexCount, nv = mesh.patch->v.vertexCount;
    const size_t points = mesh.points.empty() ? 0 : mesh.points.first().size();
    if (nu < 2 || nv < 2 || size_t(nu) * size_t(nv) > points) return;
    const size_t faces = size_t(nu - 1) * size_t(nv - 1);
    mesh.faceVertexCounts.assign(faces, 4);
    mesh.faceVertexIndices.reserve(4 * faces);
    for (int j = 0; j + 1 < nv; ++j)
        for (int i = 0; i + 1 < nu; ++i) {
            const int a = j * nu + i;
            for (int corner : {a, a + 1, a + nu + 1, a + nu})
                mesh.faceVertexIndices.push_back(corner);
        }
}

} // namespace patina
