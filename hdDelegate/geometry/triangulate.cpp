// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/triangulate.h"

#include <cmath>
#include <cstdint>

namespace patina {

namespace {

using glm::dvec2;

double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool inTriangle(const dvec2& p, const dvec2& a, const dvec2& b, const dvec2& c) {
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

void fan(int count, std::vector<uvec3>& out) {
    for (int i = 1; i + 1 < count; ++i)
        out.push_back(uvec3(0, i, i + 1));
}

/// A polygon in its plane, counterclockwise.
std::vector<dvec2> project(const vec3* corners, int count, const vec3& normal) {
    const vec3 axis = glm::abs(normal);
    int drop = axis.x > axis.y ? (axis.x > axis.z ? 0 : 2) : (axis.y > axis.z ? 1 : 2);
    int u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0.0f) std::swap(u, v);
    std::vector<dvec2> flat(count);
    for (int i = 0; i < count; ++i)
        flat[i] = dvec2(corners[i][u] - corners[0][u], corners[i][v] - corners[0][v]);
    return flat;
}

void quad(const vec3* p, std::vector<uvec3>& out) {
    const vec3 n = newellNormal(p, 4);
    // The diagonal 0-2 is inside unless the corner 1 or 3 is reflex, and the other way round.
    const auto reflex = [&](int i) {
        return glm::dot(glm::cross(p[i] - p[(i + 3) % 4], p[(i + 1) % 4] - p[i]), n) < 0.0f;
    };
    const bool reflex02 = reflex(0) || reflex(2), reflex13 = reflex(1) || reflex(3);
    const vec3 d02 = p[2] - p[0], d13 = p[3] - p[1];
    const bool along02 = reflex02 != reflex13 ? reflex02 : glm::dot(d02, d02) <= glm::dot(d13, d13);
    if (along02) {
        out.push_back(uvec3(0, 1, 2));
        out.push_back(uvec3(0, 2, 3));
    } else {
        out.push_back(uvec3(0, 1, 3));
        out.push_back(uvec3(1, 2, 3));
    }
}

} // namespace

void clipEars(const std::vector<glm::dvec2>& p, std::vector<uvec3>& out) {
    const int count = int(p.size());
    std::vector<int> next(count), previous(count);
    for (int i = 0; i < count; ++i) {
        next[i] = (i + 1) % count;
        previous[i] = (i + count - 1) % count;
    }
    // Only reflex corners can lie inside an ear; a corner never becomes reflex by clipping.
    std::vector<int> reflex;
    for (int i = 0; i < count; ++i)
        if (turn(p[previous[i]], p[i], p[next[i]]) <= 0.0) reflex.push_back(i);
    std::vector<uint8_t> gone(count);
    // A polygon that crosses itself may be tried at each corner again and again: after as many
    // tests as four rounds take, any corner will do.
    int64_t tests = 4 * int64_t(count) * int64_t(reflex.size() + 1);
    const auto isEar = [&](int i) {
        const int a = previous[i], c = next[i];
        if (tests < 0) return true;
        if (turn(p[a], p[i], p[c]) <= 0.0) return false;
        tests -= int64_t(reflex.size());
        for (int r : reflex)
            if (!gone[r] && r != a && r != i && r != c && p[r] != p[a] && p[r] != p[i] &&
                p[r] != p[c] && inTriangle(p[r], p[a], p[i], p[c]))
                return false;
        return true;
    };
    int corner = 0, tried = 0;
    for (int left = count; left > 3;) {
        // A polygon that crosses itself may have no ear: any corner then ends the search.
        if (isEar(corner) || tried > left) {
            out.push_back(uvec3(previous[corner], corner, next[corner]));
            gone[corner] = 1;
            next[previous[corner]] = next[corner];
            previous[next[corner]] = previous[corner];
            --left;
            tried = 0;
            // Going on beyond the new edge spreads the triangles instead of making a fan.
            corner = next[next[corner]];
        } else {
            corner = next[corner];
            ++tried;
        }
    }
    out.push_back(uvec3(previous[corner], corner, next[corner]));
}

vec3 newellNormal(const vec3* corners, int count) {
    vec3 normal(0.0f);
    for (int i = 1; i + 1 < count; ++i)
        normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
    return normal;
}

void triangulatePolygon(const vec3* corners, int count, std::vector<uvec3>& out) {
    if (count == 3) {
        out.push_back(uvec3(0, 1, 2));
        return;
    }
    if (count == 4) {
        quad(corners, out);
        return;
    }
    const std::vector<dvec2> flat = project(corners, count, newellNormal(corners, count));
    bool convex = true;
    for (int i = 0; i < count && convex; ++i)
        convex = turn(flat[i], flat[(i + 1) % count], flat[(i + 2) % count]) > 0.0;
    // Local turns alone do not tell a convex polygon from one that winds twice, but a fan is then
    // as good as anything.
    if (convex || count > maxEarClipping)
        fan(count, out);
    else
        clipEars(flat, out);
}

} // namespace patina
