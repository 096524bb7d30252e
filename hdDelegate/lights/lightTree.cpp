// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightTree.h"

#include <algorithm>

namespace patina {

namespace {

template <class Lanes> Lanes atLeast(float least, const Lanes& v) {
    return least < v ? v : least + Lanes{};
}
template <class Lanes> Lanes absolute(const Lanes& v) {
    return v < 0.0f ? -v : v;
}
template <class Lanes> Lanes root(Lanes v) {
    for (size_t i = 0; i < sizeof(Lanes) / sizeof(float); ++i)
        v[i] = std::sqrt(v[i]);
    return v;
}

// cos(max(0, a - b)) and its sine from those of a and b.
template <class Lanes>
Lanes cosDifference(const Lanes& sinA, const Lanes& cosA, const Lanes& sinB, const Lanes& cosB) {
    return cosA > cosB ? 1.0f + Lanes{} : cosA * cosB + sinA * sinB;
}
template <class Lanes>
Lanes sinDifference(const Lanes& sinA, const Lanes& cosA, const Lanes& sinB, const Lanes& cosB) {
    return cosA > cosB ? Lanes{} : sinA * cosB - cosA * sinB;
}
template <class Lanes> Lanes sineOf(const Lanes& cosine) {
    return root(atLeast(0.0f, 1.0f - cosine * cosine));
}

} // namespace

LightTree::Lanes LightTree::importances(const Node& node, const vec3& point, const vec3& normal,
                                        bool twoSided) {
    Lanes v[3], radius2 = {}, d2 = {};
    for (int k = 0; k < 3; ++k) {
        const Lanes extent = node.high[k] - node.low[k];
        v[k] = point[k] - 0.5f * (node.low[k] + node.high[k]);
        radius2 += extent * extent;
        d2 += v[k] * v[k];
    }
    radius2 *= 0.25f;
    const Lanes distance = root(d2);
    Lanes cosW = {}, cosI = {};
    for (int k = 0; k < 3; ++k) {
        const Lanes w = v[k] / distance;
        cosW += node.axis[k] * w;
        cosI -= normal[k] * w;
    }
    const Lanes share = radius2 / d2;
    const Lanes sinAround = root(share), cosAround = root(atLeast(0.0f, 1.0f - share));

    cosW = node.twoSided ? absolute(cosW) : cosW;
    const Lanes sinW = sineOf(cosW);
    const Lanes cosX = cosDifference(sinW, cosW, node.sinSpread, node.cosSpread);
    const Lanes sinX = sinDifference(sinW, cosW, node.sinSpread, node.cosSpread);
    const Lanes cosLeaving = cosDifference(sinX, cosX, sinAround, cosAround);

    Lanes cosArriving = 1.0f + Lanes{};
    if (normal != vec3(0.0f)) {
        if (twoSided) cosI = absolute(cosI);
        cosArriving = atLeast(0.0f, cosDifference(sineOf(cosI), cosI, sinAround, cosAround));
    }
    const Lanes apart = node.intensity * atLeast(1e-3f, cosLeaving) * cosArriving / d2;
    const Lanes seen = cosLeaving < node.cosReach - 1e-4f ? Lanes{} : apart;
    // Closer than its radius a cluster could be anywhere around.
    const Mask isAround = (d2 <= radius2 * 1.0001f) | (d2 <= 0.0f);
    return isAround ? node.intensity / atLeast(1e-30f, radius2) : seen;
}

LightTreeLeaf LightTree::asLeaf() const {
    LightTreeLeaf leaf;
    if (empty()) return leaf;
    const Node& all = _nodes[0];
    for (int k = 0; k < 3; ++k) {
        leaf.low[k] = all.low[k][0];
        leaf.high[k] = all.high[k][0];
        leaf.axis[k] = all.axis[k][0];
    }
    leaf.spread = std::atan2(all.sinSpread[0], all.cosSpread[0]);
    leaf.reach = std::acos(all.cosReach[0]);
    leaf.intensity = all.intensity[0];
    leaf.twoSided = all.twoSided[0];
    leaf.hittable = all.hittable[0];
    return leaf;
}

int LightTree::choose(const vec3& point, const vec3& normal, bool twoSided, float& u,
                      float& probability) const {
    probability = 0.0f;
    if (empty()) return -1;
    float p = 1.0f;
    int32_t child = _nodes[0].children[0];
    while (child >= 0) {
        const Node& node = _nodes[size_t(child)];
        const Lanes shares = importances(node, point, normal, twoSided);
        const float total = sum(shares);
        if (!canShare(total)) return -1;
        float left = u * total;
        int chosen = -1;
        for (int lane = 0; lane < width; ++lane) {
            if (!(shares[lane] > 0.0f)) continue;
            if (chosen >= 0) left -= shares[chosen];
            chosen = lane;
            if (left < shares[lane]) break;
        }
        u = std::clamp(left / shares[chosen], 0.0f, 0x1.fffffep-1f);
        p *= shares[chosen] / total;
        child = node.children[chosen];
    }
    probability = p;
    return int(~child);
}

float LightTree::probability(int id, const vec3& point, const vec3& normal, bool twoSided) const {
    if (id < 0 || size_t(id) >= _leafOf.size() || _leafOf[size_t(id)] < 0) return 0.0f;
    float p = 1.0f;
    int32_t at = _leafOf[size_t(id)];
    while (at >= width) { // not of the root, whose one child is all
        const Node& node = _nodes[size_t(at / width)];
        const Lanes shares = importances(node, point, normal, twoSided);
        const float total = sum(shares);
        if (!canShare(total)) return 0.0f;
        p *= shares[at % width] / total;
        at = node.parent;
    }
    return p;
}

} // namespace patina
