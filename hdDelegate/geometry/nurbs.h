// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/pointSteps.h"

namespace patina {

/// Highest order of NURBS that are drawn.
inline constexpr int highestOrder = 32;

/// Gives a direction without knots even ones, so that it begins and ends at its outer points. They
/// span what is drawn of it, or 0 to 1.
void fillKnots(NurbsDirection& direction);

/// The basis of one direction: order functions are not zero between two knots.
class NurbsBasis {
public:
    /// Between two knots that differ, as far as it is drawn.
    struct Span {
        int knot = 0; ///< that it begins at; functions knot - order + 1 to knot are not zero
        double low = 0.0, high = 0.0;
    };

    /// @param direction with nothing wrong
    explicit NurbsBasis(const NurbsDirection& direction);

    /// The reason why a direction cannot be drawn, with the attribute that says so; empty: nothing.
    struct Problem {
        std::string input, message;
        explicit operator bool() const { return !message.empty(); }
    };
    /// @param prefix of the attributes' names: u, v or nothing
    static Problem problem(const NurbsDirection& direction, const std::string& prefix);

    int order() const { return _direction.order; }
    /// Authored segments, from knot to knot, those of no length too.
    int segments() const { return _direction.vertexCount - _direction.order + 1; }
    int segment(const Span& span) const { return span.knot - _direction.order + 1; }
    /// How far a parameter lies along the whole authored segment of a span, 0..1.
    double along(const Span& span, double t) const;
    const std::vector<Span>& spans() const { return _spans; }
    double low() const { return _spans.front().low; }
    double high() const { return _spans.back().high; }
    /// Whether the surface may have an edge where a span begins.
    bool breaksBefore(const Span& span) const;
    /// Values of the functions and of their derivatives.
    /// @param values, slopes `order` each
    void evaluate(const Span& span, double t, double* values, double* slopes) const;
    /// Longest that a span of these control points can be, in their units.
    /// @param stride from one control point to the next
    double longest(const Span& span, const vec3* points, size_t stride) const;

private:
    const NurbsDirection& _direction;
    std::vector<Span> _spans;
};

/// Weights of control points, as they can be used: all 1, after a warning, for a wrong number of
/// them; 1 for those that are not positive.
std::vector<double> usableWeights(const std::vector<double>& weights, size_t points,
                                  const std::string& prim, Diagnostics& diagnostics);

/// Makes the grid of the control points the faces of the mesh, which then subdivides.
void setNurbsCage(Mesh& mesh);

/// A mesh that is a NURBS patch.
TriangleMesh drawPatch(const Mesh& mesh, const PointSteps& points,
                       const TessellationOptions& options, Diagnostics& diagnostics);

} // namespace patina
