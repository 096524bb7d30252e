// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/splitRibbons.h"

#include "hdDelegate/geometry/curveSegments.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float largestTurn = 0.25f; ///< radians across a piece
constexpr int maxPieces = 16;

/// The part from a to b of a Bezier segment, by its values and slopes there.
template <class T> void partOf(const T p[4], float a, float b, T out[4]) {
    const auto mix = [&](const vec4& w) {
        return p[0] * w[0] + p[1] * w[1] + p[2] * w[2] + p[3] * w[3];
    };
    const float third = (b - a) / 3.0f;
    out[0] = mix(basisWeights(CurveBasis::Bezier, a));
    out[3] = mix(basisWeights(CurveBasis::Bezier, b));
    out[1] = out[0] + mix(basisSlopes(CurveBasis::Bezier, a)) * third;
    out[2] = out[3] - mix(basisSlopes(CurveBasis::Bezier, b)) * third;
}

/// How far the direction across the ribbon turns, radians.
float turnOf(const vec4* points, const vec3* normals) {
    constexpr int parts = 8;
    float turn = 0.0f;
    vec3 last(0.0f);
    for (int i = 0; i <= parts; ++i) {
        const float u = float(i) / float(parts);
        const vec4 weights = basisWeights(CurveBasis::Bezier, u);
        const vec4 slopes = basisSlopes(CurveBasis::Bezier, u);
        vec3 along(0.0f), normal(0.0f);
        for (int k = 0; k < 4; ++k) {
            along += slopes[k] * vec3(points[k]);
            normal += weights[k] * normals[k];
        }
        const vec3 across = glm::cross(normal, along);
        const float length = glm::length(across);
        if (!(length > 0.0f)) continue;
        if (last != vec3(0.0f)) turn += glm::length(across / length - last);
        last = across / length;
    }
    return turn;
}

} // namespace

void splitRibbons(CurveSet& set) {
    if (set.normals.empty() || set.basis != CurveBasis::Bezier) return;
    std::vector<int> pieces;
    bool any = false;
    for (const uint32_t first : set.segments) {
        float turn = 0.0f;
        for (const auto& step : set.controlPoints)
            turn = std::max(turn, turnOf(&step[first], &set.normals[0][first]));
        pieces.push_back(int(std::ceil(std::clamp(turn / largestTurn, 1.0f, float(maxPieces)))));
        any |= pieces.back() > 1;
    }
    if (!any) return;
    CurveSet out;
    out.basis = set.basis;
    out.controlPoints.resize(set.controlPoints.size());
    out.normals.resize(1);
    for (const MeshAttribute& a : set.attributes) {
        out.attributes.push_back(a);
        if (valuesOfSegment(a.rate) > 0) out.attributes.back().data.clear();
    }
    for (size_t s = 0; s < set.segments.size(); ++s) {
        const uint32_t first = set.segments[s];
        for (int i = 0; i < pieces[s]; ++i) {
            const float a = float(i) / float(pieces[s]), b = float(i + 1) / float(pieces[s]);
            out.segments.push_back(uint32_t(out.normals[0].size()));
            vec4 points[4];
            vec3 normals[4];
            for (size_t step = 0; step < set.controlPoints.size(); ++step) {
                partOf(&set.controlPoints[step][first], a, b, points);
                for (vec4& p : points)
                    out.controlPoints[step].emplace_back(vec3(p), std::max(p.w, 0.0f));
            }
            partOf(&set.normals[0][first], a, b, normals);
            out.normals[0].insert(out.normals[0].end(), normals, normals + 4);
            out.segmentCurve.push_back(set.segmentCurve[s]);
            const vec2 u = set.segmentU[s];
            out.segmentU.emplace_back(u.x + (u.y - u.x) * a, u.x + (u.y - u.x) * b);
            if (!set.segmentSubset.empty()) out.segmentSubset.push_back(set.segmentSubset[s]);
            for (size_t k = 0; k < set.attributes.size(); ++k) {
                const MeshAttribute& from = set.attributes[k];
                const int values = valuesOfSegment(from.rate);
                const size_t n = size_t(from.components), to = out.attributes[k].data.size();
                out.attributes[k].data.resize(to + size_t(values) * n);
                for (size_t c = 0; c < n && values > 0; ++c) {
                    float in[4], part[4];
                    for (int i = 0; i < values; ++i)
                        in[i] = from.data[(size_t(values) * s + size_t(i)) * n + c];
                    if (values == 4)
                        partOf(in, a, b, part);
                    else
                        for (int i = 0; i < 2; ++i)
                            part[i] = glm::mix(in[0], in[1], i == 0 ? a : b);
                    for (int i = 0; i < values; ++i)
                        out.attributes[k].data[to + size_t(i) * n + c] = part[i];
                }
            }
        }
    }
    set = std::move(out);
}

} // namespace patina
