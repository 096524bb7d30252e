// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/types.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace patina {

/// The tree's knowledge of one light. Directions: normals of the surface lie within `spread` of
/// `axis`, and light leaves within `reach` of a normal (theta_o and theta_e of Conty Estevez and
/// Kulla).
struct LightTreeLeaf {
    int id = 0;
    vec3 low{0.0f}, high{0.0f}; ///< bounds
    vec3 axis{0.0f, 0.0f, 1.0f};
    float spread = 0.0f, reach = 1.5707963f; ///< radians
    float intensity = 0.0f;                  ///< luminous intensity along the brightest direction
    bool twoSided = false;                   ///< shines against the axis as well
    bool hittable = false;                   ///< rays can meet it
};

/// Bounding cone of directions.
struct DirectionCone {
    vec3 axis{0.0f, 0.0f, 1.0f};
    float spread = 0.0f, reach = 0.0f;
};
DirectionCone unite(const DirectionCone& a, const DirectionCone& b);

/// Chooses among many lights in proportion to an estimate of what each gives to a point (Conty
/// Estevez and Kulla 2018, Importance Sampling of Many Lights with Adaptive Tree Splitting; one
/// random number picks one light). Building takes O(n log n), choosing O(log n). The tree serves
/// as the bounding volumes for rays, too. A node has up to four children, which are looked at
/// together, in lanes of one register.
class LightTree {
public:
    LightTree() = default;
    explicit LightTree(const std::vector<LightTreeLeaf>& leaves);

    bool empty() const { return _nodes.empty(); }

    /// Estimate of the irradiance from all lights at a point; 0 only when there is none.
    float importance(const vec3& point, const vec3& normal, bool twoSided) const {
        return empty() ? 0.0f : importances(_nodes[0], point, normal, twoSided)[0];
    }

    /// All of its lights as one: a leaf for a tree above it.
    LightTreeLeaf asLeaf() const;

    /// @param u uniform in [0, 1); becomes a number that is uniform again
    /// @returns id of a light, or -1 when nothing reaches the point on this way down
    int choose(const vec3& point, const vec3& normal, bool twoSided, float& u,
               float& probability) const;

    /// Probability with which choose() gives this light; 0 for an id that is not in the tree.
    float probability(int id, const vec3& point, const vec3& normal, bool twoSided) const;

    /// Calls visit(id) for the hittable lights whose bounds the ray meets. `far` may shrink while
    /// it goes on.
    template <class Visit> void visitRay(const vec3& origin, const vec3& direction, float near,
                                         const float& far, const Visit& visit) const;

private:
    static constexpr int width = 4;
    typedef float Lanes __attribute__((vector_size(4 * width)));
    typedef int32_t Mask __attribute__((vector_size(4 * width))); ///< of each lane all bits or none

    /// What is known of each child; lanes without one have no intensity. The root's one child is
    /// all.
    struct Node {
        Lanes low[3] = {}, high[3] = {}, axis[3] = {};
        Lanes cosSpread = {}, sinSpread = {}, cosReach = {}, intensity = {};
        Mask twoSided = {}, hittable = {};
        int32_t children[width] = {}; ///< a node; below 0: ~id of a light
        int32_t parent = -1;          ///< a node and one of its lanes, as place() has it
    };
    static int32_t place(int32_t node, int lane) { return width * node + lane; }

    static Lanes importances(const Node& node, const vec3& point, const vec3& normal,
                             bool twoSided);
    static float sum(const Lanes& v) { return v[0] + v[1] + v[2] + v[3]; }
    static bool canShare(float total) { return total > 0.0f && total < INFINITY; }

    std::vector<Node> _nodes;
    std::vector<int32_t> _leafOf; ///< place of each id, or -1
};

template <class Visit> void LightTree::visitRay(const vec3& origin, const vec3& direction,
                                                float near, const float& far,
                                                const Visit& visit) const {
    if (empty()) return;
    const vec3 inverse = 1.0f / direction;
    std::vector<int32_t> deep; // only for degenerate trees
    int32_t stack[64];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
        const Node& node = _nodes[size_t(stack[--size])];
        if (size == 0 && !deep.empty()) { // one of those that found no room
            stack[size++] = deep.back();
            deep.pop_back();
        }
        Lanes t0 = near + Lanes{}, t1 = far + Lanes{};
        for (int k = 0; k < 3; ++k) {
            const Lanes a = (node.low[k] - origin[k]) * inverse[k];
            const Lanes b = (node.high[k] - origin[k]) * inverse[k];
            // NaN (a ray in the plane of a flat box) leaves the interval as it is.
            const Lanes first = (b < a ? b : a) * (1.0f - 1e-6f);
            const Lanes last = (a > b ? a : b) * (1.0f + 1e-6f);
            t0 = first > t0 ? first : t0;
            t1 = last < t1 ? last : t1;
        }
        const Mask met = (t0 <= t1) & node.hittable;
        for (int lane = 0; lane < width; ++lane) {
            if (!met[lane]) continue;
            const int32_t child = node.children[lane];
            if (child < 0)
                visit(int(~child));
            else if (size < 64)
                stack[size++] = child;
            else
                deep.push_back(child);
        }
    }
}

} // namespace patina
