// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/refineValues.h"

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>

namespace patina {

namespace {

namespace Far = OpenSubdiv::Far;

/// One value inside an array of floats, as PrimvarRefiner wants to see it.
struct Item {
    float* data;
    int components;

    void Clear() { std::fill_n(data, components, 0.0f); }
    void AddWithWeight(const Item& source, float weight) {
        for (int i = 0; i < components; ++i)
            data[i] += weight * source.data[i];
    }
};

/// An array of floats seen as values.
struct Items {
    float* data;
    int components;

    Items(std::vector<float>& values, int n) : data(values.data()), components(n) {}
    Item operator[](int i) const { return {data + size_t(i) * components, components}; }
};

int valueCount(const Far::TopologyLevel& level, RefineMode mode, int channel) {
    return mode == RefineMode::FaceVarying ? level.GetNumFVarValues(channel)
                                           : level.GetNumVertices();
}

/// Values at the last level, before they are moved to the limit.
std::vector<float> interpolateLevels(const Far::TopologyRefiner& refiner, std::vector<float> base,
                                     int components, RefineMode mode, int channel) {
    const Far::PrimvarRefiner primvars(refiner);
    std::vector<float> next;
    for (int level = 1; level <= refiner.GetMaxLevel(); ++level) {
        next.assign(size_t(valueCount(refiner.GetLevel(level), mode, channel)) * components, 0.0f);
        const Items source(base, components);
        Items target(next, components);
        if (mode == RefineMode::Vertex)
            primvars.Interpolate(level, source, target);
        else if (mode == RefineMode::Varying)
            primvars.InterpolateVarying(level, source, target);
        else
            primvars.InterpolateFaceVarying(level, source, target, channel);
        std::swap(base, next);
    }
    return base;
}

} // namespace

std::vector<float> refineValues(const Far::TopologyRefiner& refiner, std::vector<float> base,
                                int components, RefineMode mode, int channel) {
    std::vector<float> last =
        interpolateLevels(refiner, std::move(base), components, mode, channel);
    if (mode == RefineMode::Varying) return last;
    std::vector<float> limit(last.size());
    const Items source(last, components);
    Items target(limit, components);
    const Far::PrimvarRefiner primvars(refiner);
    if (mode == RefineMode::Vertex)
        primvars.Limit(source, target);
    else
        primvars.LimitFaceVarying(source, target, channel);
    return limit;
}

LimitPoints refinePoints(const Far::TopologyRefiner& refiner, std::vector<float> base) {
    std::vector<float> last = interpolateLevels(refiner, std::move(base), 3, RefineMode::Vertex, 0);
    LimitPoints result;
    for (auto* out : {&result.positions, &result.tangents1, &result.tangents2})
        out->resize(last.size());
    const Items source(last, 3);
    Items positions(result.positions, 3), t1(result.tangents1, 3), t2(result.tangents2, 3);
    Far::PrimvarRefiner(refiner).Limit(source, positions, t1, t2);
    return result;
}

} // namespace patina
