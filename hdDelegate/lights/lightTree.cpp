// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightTree.h"

#include <algorithm>

namespace patina {

namespace {

// cos(max(0, a - b)) and its sine from those of a and b.
float cosDifference(float sinA, float cosA, float sinB, float cosB) {
    return cosA > cosB ? 1.0f : cosA * cosB + sinA * sinB;
}
float sinDifference(float sinA, float cosA, float sinB, float cosB) {
    return cosA > cosB ? 0.0f : sinA * cosB - cosA * sinB;
}
float sineOf(float cosine) {
    return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

} // namespace

float LightTree::importance(const Node& node, const vec3& point, const vec3& normal,
                            bool twoSided) {
    const vec3 center = 0.5f * (node.low + node.high), extent = node.high - node.low;
    const float radius2 = 0.25f * glm::dot(extent, extent);
    const vec3 v = point - center;
    const float d2 = glm::dot(v, v);
    // Closer than its radius a cluster could be anywhere around.
    if (d2 <= radius2 * 1.0001f || !(d2 > 0.0f)) return node.intensity / std::max(radius2, 1e-30f);
    const vec3 w = v / std::sqrt(d2);
    const float sinAround = std::sqrt(radius2 / d2);
    const float cosAround = std::sqrt(std::max(0.0f, 1.0f - radius2 / d2));

    float cosW = glm::dot(node.axis, w);
    if (node.twoSided) cosW = std::abs(cosW);
    const float sinW = sineOf(cosW);
    const float cosX = cosDifference(sinW, cosW, node.sinSpread, node.cosSpread);
    const float sinX = sinDifference(sinW, cosW, node.sinSpread, node.cosSpread);
    const float cosLeaving = cosDifference(sinX, cosX, sinAround, cosAround);
    if (cosLeaving < node.cosReach - 1e-4f) return 0.0f;

    float cosArriving = 1.0f;
    if (normal != vec3(0.0f)) {
        float cosI = -glm::dot(w, normal);
        if (twoSided) cosI = std::abs(cosI);
        cosArriving = cosDifference(sineOf(cosI), cosI, sinAround, cosAround);
        if (cosArriving <= 0.0f) return 0.0f;
    }
    return node.intensity * std::max(cosLeaving, 1e-3f) * cosArriving / d2;
}

LightTreeLeaf LightTree::asLeaf() const {
    LightTreeLeaf leaf;
    if (empty()) return leaf;
    const Node& root = _nodes[0];
    leaf.low = root.low;
    leaf.high = root.high;
    leaf.axis = root.axis;
    leaf.spread = std::atan2(root.sinSpread, root.cosSpread);
    leaf.reach = std::acos(root.cosReach);
    leaf.intensity = root.intensity;
    leaf.twoSided = root.twoSided;
    leaf.hittable = root.hittable;
    return leaf;
}

int LightTree::choose(const vec3& point, const vec3& normal, bool twoSided, float& u,
                      float& probability) const {
    probability = 0.0f;
    if (empty()) return -1;
    float p = 1.0f;
    int32_t index = 0;
    while (_nodes[index].left >= 0) {
        const Node& node = _nodes[index];
        const float a = importance(_nodes[node.left], point, normal, twoSided);
        const float b = importance(_nodes[node.right], point, normal, twoSided);
        if (!(a + b > 0.0f)) return -1;
        const float pa = a / (a + b);
        if (u < pa) {
            index = node.left;
            u = std::min(u / pa, 0x1.fffffep-1f);
            p *= pa;
        } else {
            index = node.right;
            const float pb = b / (a + b);
            u = std::min((u - pa) / std::max(1.0f - pa, 1e-30f), 0x1.fffffep-1f);
            p *= pb;
            if (!(pb > 0.0f)) return -1;
        }
    }
    probability = p;
    return int(_nodes[index].right);
}

float LightTree::probability(int id, const vec3& point, const vec3& normal, bool twoSided) const {
    if (id < 0 || size_t(id) >= _leafOf.size() || _leafOf[id] < 0) return 0.0f;
    float p = 1.0f;
    for (int32_t index = _leafOf[id]; _nodes[index].parent >= 0; index = _nodes[index].parent) {
        const Node& parent = _nodes[_nodes[index].parent];
        const float a = importance(_nodes[parent.left], point, normal, twoSided);
        const float b = importance(_nodes[parent.right], point, normal, twoSided);
        if (!(a + b > 0.0f)) return 0.0f;
        p *= (index == parent.left ? a : b) / (a + b);
    }
    return p;
}

} // namespace patina
