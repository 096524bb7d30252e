// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/drawnFaces.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using Rate = MeshAttribute::Rate;

Rate rateOf(Interpolation interpolation) {
    switch (interpolation) {
    case Interpolation::Uniform: return Rate::PerFace;
    case Interpolation::Varying:
    case Interpolation::Vertex: return Rate::PerVertex;
    case Interpolation::FaceVarying: return Rate::PerCorner;
    default: return Rate::Constant;
    }
}

std::vector<vec3> unitVectors(const std::vector<float>& data, size_t& zeros) {
    std::vector<vec3> out(data.size() / 3);
    for (size_t i = 0; i < out.size(); ++i) {
        const vec3 n(data[3 * i], data[3 * i + 1], data[3 * i + 2]);
        const float length = glm::length(n);
        const bool usable = length > 0.0f && std::isfinite(length);
        out[i] = usable ? n / length : vec3(0.0f);
        zeros += !usable;
    }
    return out;
}

/// Puts geometric normals where authored ones have no direction.
void repairNormals(TriangleMesh& out) {
    const std::vector<vec3> smooth = smoothNormals(out.positions[0], out.triangles);
    for (size_t t = 0; t < out.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const uint32_t vertex = out.triangles[t][k];
            const size_t index = out.normalRate == Rate::PerVertex ? vertex
                                 : out.normalRate == Rate::PerFace ? size_t(out.triangleFace[t])
                                                                   : 3 * t + k;
            vec3& n = out.normals[0][index];
            if (n == vec3(0.0f)) n = smooth[vertex];
        }
    for (vec3& n : out.normals[0])
        if (n == vec3(0.0f)) n = vec3(0, 0, 1);
}

void useAuthoredNormals(const Mesh& mesh, const Primvar& primvar, const ElementCounts& counts,
                        const DrawnTriangles& drawn, Diagnostics& diagnostics, TriangleMesh& out) {
    if (primvar.components != 3) {
        diagnostics.warn(mesh.path, "normals", messages::normalsNoVectors);
        return;
    }
    std::vector<float> data;
    if (!expandPrimvar(primvar, counts, mesh.path, diagnostics, data)) return;
    out.normalRate = rateOf(primvar.interpolation);
    if (out.normalRate == Rate::PerCorner) data = gatherCorners(drawn, data, {}, 3);
    size_t zeros = 0;
    std::vector<vec3> normals = unitVectors(data, zeros);
    if (out.normalRate == Rate::Constant) {
        out.normalRate = Rate::PerVertex;
        normals.assign(out.positions[0].size(), normals[0]);
    }
    out.normals = {std::move(normals)};
    if (zeros == 0) return;
    diagnostics.warn(mesh.path, "normals", messages::normalsWithoutDirection(zeros));
    repairNormals(out);
}

} // namespace

TriangleMesh drawPolygons(const Mesh& mesh, PointSteps points, const CageFaces& faces,
                          CageNormals source, Diagnostics& diagnostics) {
    TriangleMesh out;
    out.positions = std::move(points.steps);
    const bool cornersMatter =
        std::any_of(mesh.primvars.begin(), mesh.primvars.end(), [](const Primvar& primvar) {
            return rateOf(primvar.interpolation) == Rate::PerCorner;
        });
    DrawnTriangles drawn =
        drawFaces(faces, mesh.faceVertexIndices, out.positions[0], mesh.leftHanded, cornersMatter);
    out.triangles = std::move(drawn.triangles);
    out.triangleFace = std::move(drawn.faces);

    ElementCounts counts;
    counts.uniform = faces.authoredFaces;
    counts.varying = counts.vertex = out.positions[0].size();
    counts.faceVarying = faces.authoredCorners;

    if (source == CageNormals::Smooth) {
        for (const auto& step : out.positions)
            out.normals.push_back(smoothNormals(step, out.triangles));
    } else if (const Primvar* normals = mesh.primvar("normals")) {
        useAuthoredNormals(mesh, *normals, counts, drawn, diagnostics, out);
    }
    for (const Primvar& primvar : mesh.primvars) {
        if (primvar.name == "normals") continue;
        MeshAttribute attribute;
        attribute.name = primvar.name;
        attribute.components = primvar.components;
        attribute.rate = rateOf(primvar.interpolation);
        if (!expandPrimvar(primvar, counts, mesh.path, diagnostics, attribute.data)) continue;
        if (attribute.rate == Rate::PerCorner)
            attribute.data = gatherCorners(drawn, attribute.data, {}, primvar.components);
        out.attributes.push_back(std::move(attribute));
    }
    finishMesh(mesh, diagnostics, out);
    return out;
}

} // namespace patina
