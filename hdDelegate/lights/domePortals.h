// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <functional>
#include <vector>

namespace patina {

/// A rectangle through which a dome is sampled: the part of the sky that a point sees through it is
/// a rectangle of a map whose coordinates are the angles atan(x/z) and atan(y/z) about the portal's
/// axes (Bitterli, Novak and Jarosz 2015, Portal-Masked Environment Map Sampling). A table of sums
/// gives what that part is worth, and inverts it.
class DomePortal {
public:
    static constexpr int size = 256; ///< cells of the map along a side

    /// @param toWorld of the rectangle of this width and height in the plane z = 0, lit along -z;
    ///        shear is dropped
    /// @param luminance of the sky in a world direction
    DomePortal(const mat4& toWorld, float width, float height,
               const std::function<float(const vec3&)>& luminance);
    bool valid() const { return _valid; }

    /// The part of the map that a point sees through the portal, in cells.
    struct Window {
        float low[2] = {0, 0}, high[2] = {0, 0};
        double worth = 0.0; ///< 0 where it sees nothing
    };
    Window window(const vec3& point) const;
    /// @param u in [0,1)
    vec3 sample(const Window& window, const vec2& u) const;
    /// Density by solid angle of sample(); 0 outside of the window.
    float pdf(const Window& window, const vec3& direction) const;

private:
    double sumTo(float x, float y) const; ///< of all cells before, and of shares of cells
    double sumOf(const float low[2], const float high[2]) const;
    double cell(int x, int y) const;

    bool _valid = false;
    vec3 _center{0.0f}, _x{1, 0, 0}, _y{0, 1, 0}, _z{0, 0, 1};
    float _half[2] = {0.0f, 0.0f};
    std::vector<double> _sums; ///< (size + 1)^2
};

/// All portals of a dome beside its own way of sampling: the density is a mix of both, so light
/// that comes in elsewhere is found too.
class DomePortals {
public:
    static constexpr float elsewhere = 0.125f; ///< share of samples that portals do not guide

    void add(DomePortal portal) { _portals.push_back(std::move(portal)); }
    bool empty() const { return _portals.empty(); }
    /// @param u in [0,1); used up where it is not for the portals
    /// @returns false when the sample is to be taken elsewhere
    bool sample(const vec3& point, vec2& u, vec3& direction) const;
    /// Of the mix, by solid angle. @param own density of the dome's own samples
    float pdf(const vec3& point, const vec3& direction, float own) const;

private:
    std::vector<DomePortal> _portals;
};

} // namespace patina
