// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightTree.h"

#include "base/maths.h"

#include <algorithm>
#include <array>

namespace patina {

namespace {
constexpr int binCount = 12;

/// A running union of leaves.
struct Cluster {
    vec3 low{INFINITY}, high{-INFINITY};
    DirectionCone cone;
    float intensity = 0.0f;
    int count = 0;
    bool twoSided = false, hittable = false;

    void add(const Cluster& c) {
        if (c.count == 0) return;
        cone = count == 0 ? c.cone : unite(cone, c.cone);
        low = glm::min(low, c.low);
        high = glm::max(high, c.high);
        intensity += c.intensity;
        count += c.count;
        twoSided = twoSided || c.twoSided;
        hittable = hittable || c.hittable;
    }
};

Cluster clusterOf(const LightTreeLeaf& leaf) {
    Cluster c;
    c.low = leaf.low;
    c.high = leaf.high;
    c.cone = {leaf.axis, leaf.spread, leaf.reach};
    c.intensity = leaf.intensity;
    c.count = 1;
    c.twoSided = leaf.twoSided;
    c.hittable = leaf.hittable;
    return c;
}

/// Solid angle of the directions that a cone reaches, weighted by the cosine (equation 1 of the
/// paper).
float orientationMeasure(const DirectionCone& cone) {
    const float o = cone.spread, w = std::min(o + cone.reach, pi);
    return 2.0f * pi * (1.0f - std::cos(o)) + 0.5f * pi *
                                                  (2.0f * w * std::sin(o) - std::cos(o - 2.0f * w) -
                                                   2.0f * o * std::sin(o) + std::cos(o));
}

/// Surface area orientation heuristic, without the factor that all candidates of an axis share.
/// @param pad keeps rows of point lights from having no area at all
float cost(const Cluster& c, float pad) {
    const vec3 e = c.high - c.low + pad;
    const float area = e.x * e.y + e.y * e.z + e.z * e.x;
    return c.intensity * area * orientationMeasure(c.cone);
}

struct Split {
    int axis = -1, bin = 0;
    float cost = INFINITY;
};

int binOf(float center, float low, float length) {
    return std::clamp(int((center - low) / length * binCount), 0, binCount - 1);
}

Split bestSplit(const std::vector<LightTreeLeaf>& leaves, const std::vector<int>& order, int begin,
                int end, const vec3& low, const vec3& high) {
    Split best;
    const vec3 length = high - low;
    const float longest = std::max({length.x, length.y, length.z});
    for (int axis = 0; axis < 3; ++axis) {
        if (!(length[axis] > 0.0f)) continue;
        std::array<Cluster, binCount> bins, after;
        for (int i = begin; i < end; ++i) {
            const LightTreeLeaf& leaf = leaves[order[i]];
            const float center = 0.5f * (leaf.low[axis] + leaf.high[axis]);
            bins[binOf(center, low[axis], length[axis])].add(clusterOf(leaf));
        }
        Cluster running;
        for (int b = binCount - 1; b > 0; --b) {
            running.add(bins[b]);
            after[b] = running;
        }
        running = Cluster();
        const float pad = 1e-3f * longest;
        for (int b = 0; b + 1 < binCount; ++b) {
            running.add(bins[b]);
            if (running.count == 0 || after[b + 1].count == 0) continue;
            const float c =
                (cost(running, pad) + cost(after[b + 1], pad)) * (longest / length[axis]);
            if (c < best.cost) best = {axis, b, c};
        }
    }
    return best;
}

/// A tree of two children, of which the one of four is made.
struct Pair {
    Cluster all;
    int32_t left = -1, right = -1; ///< right is the id of the light in a leaf (left < 0)
};

} // namespace

DirectionCone unite(const DirectionCone& a, const DirectionCone& b) {
    const DirectionCone& wide = a.spread >= b.spread ? a : b;
    const DirectionCone& slim = a.spread >= b.spread ? b : a;
    DirectionCone result = wide;
    result.reach = std::max(a.reach, b.reach);
    const float between = std::acos(std::clamp(glm::dot(wide.axis, slim.axis), -1.0f, 1.0f));
    if (std::min(between + slim.spread, pi) <= wide.spread) return result;
    result.spread = 0.5f * (wide.spread + between + slim.spread);
    if (result.spread >= pi) {
        result.spread = pi;
        return result;
    }
    const vec3 across = slim.axis - glm::dot(slim.axis, wide.axis) * wide.axis;
    const float length = glm::length(across);
    if (!(length > 1e-6f)) {
        if (between > 0.5f * pi) // opposite axes: no plane to turn in
            result.spread = pi;
        return result;
    }
    const float turn = result.spread - wide.spread;
    result.axis = glm::normalize(std::cos(turn) * wide.axis + std::sin(turn) * (across / length));
    // Rounding must not leave directions outside.
    result.spread = std::min(result.spread + 1e-4f, pi);
    return result;
}

/// @returns the root first
static std::vector<Pair> pairsOf(const std::vector<LightTreeLeaf>& leaves) {
    std::vector<Pair> pairs;
    pairs.reserve(2 * leaves.size() - 1);
    std::vector<int> order(leaves.size());
    for (size_t i = 0; i < order.size(); ++i)
        order[i] = int(i);

    struct Task {
        int begin, end;
        int32_t parent;
        bool isLeft;
    };
    std::vector<Task> tasks = {{0, int(order.size()), -1, false}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        Pair pair;
        vec3 low(INFINITY), high(-INFINITY); // of the centres
        for (int i = task.begin; i < task.end; ++i) {
            const LightTreeLeaf& leaf = leaves[order[i]];
            pair.all.add(clusterOf(leaf));
            const vec3 center = 0.5f * (leaf.low + leaf.high);
            low = glm::min(low, center);
            high = glm::max(high, center);
        }
        const int32_t index = int32_t(pairs.size());
        if (task.parent >= 0)
            (task.isLeft ? pairs[task.parent].left : pairs[task.parent].right) = index;
        if (task.end - task.begin == 1) {
            pair.right = leaves[order[task.begin]].id;
            pairs.push_back(pair);
            continue;
        }
        pair.left = 0; // an inner node; the children write themselves in
        pairs.push_back(pair);
        const Split split = bestSplit(leaves, order, task.begin, task.end, low, high);
        int middle = (task.begin + task.end) / 2;
        if (split.axis >= 0) {
            const int axis = split.axis;
            const auto at = std::stable_partition(
                order.begin() + task.begin, order.begin() + task.end, [&](int i) {
                    const float center = 0.5f * (leaves[i].low[axis] + leaves[i].high[axis]);
                    return binOf(center, low[axis], high[axis] - low[axis]) <= split.bin;
                });
            middle = int(at - order.begin());
        }
        if (middle <= task.begin || middle >= task.end) middle = (task.begin + task.end) / 2;
        tasks.push_back({middle, task.end, index, false});
        tasks.push_back({task.begin, middle, index, true});
    }
    return pairs;
}

LightTree::LightTree(const std::vector<LightTreeLeaf>& leaves) {
    if (leaves.empty()) return;
    int largestId = 0;
    for (const LightTreeLeaf& leaf : leaves)
        largestId = std::max(largestId, leaf.id);
    _leafOf.assign(size_t(largestId) + 1, -1);
    const std::vector<Pair> pairs = pairsOf(leaves);

    struct Task {
        int32_t at;                  ///< place() of what follows
        std::array<int32_t, 4> held; ///< pairs that it has below it
        int count;
    };
    static_assert(width == 4, "as many as a task holds");
    std::vector<Task> tasks = {{-1, {0}, 1}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        const int32_t index = int32_t(_nodes.size());
        if (task.at >= 0) _nodes[size_t(task.at / width)].children[task.at % width] = index;
        Node node;
        node.parent = task.at;
        for (int lane = 0; lane < task.count; ++lane) {
            const Pair& pair = pairs[size_t(task.held[size_t(lane)])];
            const Cluster& all = pair.all;
            for (int k = 0; k < 3; ++k) {
                node.low[k][lane] = all.low[k];
                node.high[k][lane] = all.high[k];
                node.axis[k][lane] = all.cone.axis[k];
            }
            node.cosSpread[lane] = std::cos(all.cone.spread);
            node.sinSpread[lane] = std::sin(all.cone.spread);
            node.cosReach[lane] = std::cos(all.cone.reach);
            node.intensity[lane] = all.intensity;
            node.twoSided[lane] = all.twoSided ? -1 : 0;
            node.hittable[lane] = all.hittable ? -1 : 0;
            if (pair.left < 0) {
                node.children[lane] = ~pair.right;
                _leafOf[size_t(pair.right)] = place(index, lane);
                continue;
            }
            // The brightest of those below are taken apart, which are asked for most.
            Task next = {place(index, lane), {pair.left, pair.right}, 2};
            while (next.count < width) {
                int brightest = -1;
                for (int i = 0; i < next.count; ++i) {
                    const Pair& held = pairs[size_t(next.held[size_t(i)])];
                    if (held.left >= 0 &&
                        (brightest < 0 ||
                         held.all.intensity >
                             pairs[size_t(next.held[size_t(brightest)])].all.intensity))
                        brightest = i;
                }
                if (brightest < 0) break;
                const Pair& apart = pairs[size_t(next.held[size_t(brightest)])];
                next.held[size_t(brightest)] = apart.left;
                next.held[size_t(next.count++)] = apart.right;
            }
            tasks.push_back(next);
        }
        _nodes.push_back(node);
    }
}

} // namespace patina
