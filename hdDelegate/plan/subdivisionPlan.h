// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/plan/primExtent.h"
#include "hdDelegate/scene/settings.h"
#include "materialNetwork/plan/methodPlan.h"

namespace patina {

/// Share of the tolerance that subdivision surfaces may take by being drawn with flat triangles.
constexpr double subdivisionShare = 0.1;

/// Finds how long edges of subdivision surfaces may be on screen, one length for all of an image:
/// the longest whose predicted error is within subdivisionShare of the tolerance, by the rows
/// `subdivision` of the table. A row's error counts by the share of the image that a surface
/// covers; surfaces larger than those measured are off by less, with the square of their size.
/// With a tolerance of 0 it is the shortest, half a pixel (a prim is still not refined beyond six
/// levels or a million triangles); without one the settings' or four pixels.
class SubdivisionPlan {
public:
    static constexpr float standardEdge = 4.0f; ///< pixels; the default of the choice point

    SubdivisionPlan(const RenderSettings& settings, const ScreenScale& screen);

    /// Whether there is anything to choose; else no surface has to be added.
    bool isActive() const { return _active; }
    /// @param cage of a subdivision surface
    /// @param places from object to world
    /// @param material of the surface, as planned
    /// @param each places that one of them stands for
    void add(const PrimExtent& cage, const std::vector<mat4>& places, const MethodPlan& material,
             double each = 1.0);

    /// Of the choice point `subdivision`; without a name where no surface was added.
    PlannedMethod chosen() const;
    /// Pixels.
    float edgeLength() const;

private:
    struct Seen {
        double share, size; ///< of the image, 0..1; pixels
        double microfacetShare, roughness;
    };
    double error(const std::string& method) const;
    std::string choose() const;

    const RenderSettings& _settings;
    ScreenScale _screen;
    bool _active, _any = false;
    std::vector<Seen> _seen;
};

} // namespace patina
