// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/drawnFaces.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Values per point, whatever the interpolation; empty when the primvar is missing or unusable.
std::vector<float> perPoint(const Points& prim, const char* name, int components, size_t count,
                            Diagnostics& diagnostics) {
    const Primvar* primvar = prim.primvar(name);
    std::vector<float> values;
    if (!primvar) return values;
    if (primvar->components != components) {
        diagnostics.warn(prim.path, name, messages::wrongTypeIgnored);
        return values;
    }
    ElementCounts counts;
    counts.varying = counts.vertex = counts.faceVarying = count;
    if (!expandPrimvar(*primvar, counts, prim.path, diagnostics, values)) return {};
    // One value stands for all points.
    const size_t given = values.size() / components;
    if (given == 1 && count > 1) {
        values.reserve(count * components);
        for (size_t i = 1; i < count; ++i)
            values.insert(values.end(), values.begin(), values.begin() + components);
    }
    return values;
}

} // namespace

PointSet buildPoints(const Points& prim, const TessellationOptions& options,
                     Diagnostics& diagnostics) {
    const PointSteps points = resamplePoints(prim.points, prim.path, options, diagnostics);
    const size_t count = points.count();
    if (count == 0) diagnostics.warn(prim.path, "points", messages::noPoints);
    const std::vector<float> widths = perPoint(prim, "widths", 1, count, diagnostics);
    const std::vector<float> normals = perPoint(prim, "normals", 3, count, diagnostics);
    const std::vector<uint16_t> subsetOf = subsetOfElements(prim, count, diagnostics);

    PointSet out;
    out.points.resize(points.steps.size());
    if (!normals.empty()) out.normals.resize(1);
    size_t notFinite = 0, negative = 0;
    for (size_t i = 0; i < count; ++i) {
        if (points.isBad(i)) {
            ++notFinite;
            continue;
        }
        const float width = widths.empty() ? 1.0f : widths[i];
        negative += width < 0.0f;
        for (size_t step = 0; step < points.steps.size(); ++step)
            out.points[step].push_back(vec4(points.steps[step][i], 0.5f * std::max(width, 0.0f)));
        if (!normals.empty()) {
            const vec3 n(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
            const float length = glm::length(n);
            out.normals[0].push_back(length > 0.0f ? n / length : vec3(0, 0, 1));
        }
        out.pointIndex.push_back(int(i));
        if (!subsetOf.empty()) out.pointSubset.push_back(subsetOf[i]);
    }
    if (notFinite > 0) diagnostics.warn(prim.path, "points", messages::pointsNotFinite(notFinite));
    if (negative > 0) diagnostics.warn(prim.path, "widths", messages::widthsNegative(negative));

    ElementCounts counts;
    counts.varying = counts.vertex = counts.faceVarying = count;
    for (const Primvar& primvar : prim.primvars) {
        MeshAttribute attribute;
        if (primvar.name == "widths" || primvar.name == "normals" ||
            !expandPrimvar(primvar, counts, prim.path, diagnostics, attribute.data))
            continue;
        attribute.name = primvar.name;
        attribute.components = primvar.components;
        const bool constant = primvar.interpolation == Interpolation::Constant ||
                              primvar.interpolation == Interpolation::Uniform;
        attribute.rate = constant ? MeshAttribute::Rate::Constant : MeshAttribute::Rate::PerVertex;
        // Values of points that were left out go too.
        if (!constant && notFinite > 0) {
            const int n = primvar.components;
            std::vector<float> kept;
            for (int i : out.pointIndex)
                kept.insert(kept.end(), attribute.data.begin() + size_t(i) * n,
                            attribute.data.begin() + size_t(i + 1) * n);
            attribute.data = std::move(kept);
        }
        out.attributes.push_back(std::move(attribute));
    }
    if (out.pointIndex.empty()) return out;
    out.boundsMin = vec3(INFINITY);
    out.boundsMax = vec3(-INFINITY);
    for (const auto& step : out.points)
        for (const vec4& p : step) {
            out.boundsMin = glm::min(out.boundsMin, vec3(p) - p.w);
            out.boundsMax = glm::max(out.boundsMax, vec3(p) + p.w);
        }
    return out;
}

} // namespace patina
