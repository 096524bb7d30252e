// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeScene.h"

#include <map>
#include <vector>

namespace patina {

/// A hit on a triangle that no ray has made.
/// @param uv weights of its vertices 1 and 2
Hit hitOn(const Surface* surface, unsigned primitive, const GroupPlace& place, vec2 uv);

/// Whether a material sends light on that is worth following from the lights: clear solids.
bool castsCaustics(const MaterialProgram& program);

/// The surfaces that caustics come from, by their area. Immutable.
class CausticCasters {
public:
    explicit CausticCasters(const EmbreeScene& scene);

    bool empty() const { return _placed.empty(); }
    /// Whether all that casts has triangles to send photons from.
    bool complete() const { return _complete; }

    /// A point of a caster.
    struct Point {
        Hit hit;                           ///< without a distance
        vec3 position{0.0f}, normal{0.0f}; ///< normal of the triangle, on its front
        float pdf = 0.0f;                  ///< by area; 0: there is none
    };
    /// @param u for the place on a triangle; @param which for the surface and the triangle
    Point sample(vec2 u, vec2 which, float time) const;

private:
    struct Shape {
        const Surface* surface;
        std::vector<unsigned> triangles;
        std::vector<float> sums; ///< of areas in the group's space, up to each; the last is 1
        float area = 0.0f;
    };
    struct Placed {
        int shape;
        GroupPlace place;
    };

    bool _complete = true;
    std::vector<Shape> _shapes;
    std::vector<Placed> _placed;
    std::vector<float> _sums; ///< of areas in the world, roughly; the last is 1
    std::shared_ptr<const Placements> _placements; ///< keeps what places point to
};

} // namespace patina
