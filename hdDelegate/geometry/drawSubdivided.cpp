// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/geometry/drawnFaces.h"
#include "hdDelegate/geometry/refineValues.h"
#include "hdDelegate/geometry/sharpNormals.h"
#include "hdDelegate/geometry/subdivCage.h"

#include <cmath>

namespace patina {

namespace {

namespace Far = OpenSubdiv::Far;
using Rate = MeshAttribute::Rate;

/// A primvar with its values on the cage.
struct CagePrimvar {
    const Primvar* primvar = nullptr;
    std::vector<float> values; ///< per authored element; empty for face-varying ones
    int channel = -1;
};

/// The faces of the last level, as drawFaces takes them.
struct LastLevel {
    CageFaces faces;
    std::vector<int> vertices;
};

LastLevel lastLevel(const Far::TopologyRefiner& refiner, const SubdivCage& cage) {
    std::vector<int> authored = cage.authoredFace;
    for (int l = 1; l <= refiner.GetMaxLevel(); ++l) {
        const Far::TopologyLevel& level = refiner.GetLevel(l);
        std::vector<int> next(level.GetNumFaces());
        for (int f = 0; f < level.GetNumFaces(); ++f)
            next[f] = authored[level.GetFaceParentFace(f)];
        authored = std::move(next);
    }
    const Far::TopologyLevel& level = refiner.GetLevel(refiner.GetMaxLevel());
    LastLevel last;
    last.faces.authored = std::move(authored);
    last.faces.counts.reserve(level.GetNumFaces());
    last.faces.firstCorner.reserve(level.GetNumFaces());
    last.vertices.reserve(level.GetNumFaceVertices());
    if (refiner.HasHoles()) last.faces.hole.resize(level.GetNumFaces());
    for (int f = 0; f < level.GetNumFaces(); ++f) {
        const auto corners = level.GetFaceVertices(f);
        last.faces.counts.push_back(corners.size());
        last.faces.firstCorner.push_back(last.vertices.size());
        last.vertices.insert(last.vertices.end(), corners.begin(), corners.end());
        if (refiner.HasHoles()) last.faces.hole[f] = level.IsFaceHole(f);
    }
    return last;
}

std::vector<vec3> toVectors(const std::vector<float>& values) {
    std::vector<vec3> out;
    out.reserve(values.size() / 3 + 1); // Embree reads 16 bytes of the last point
    for (size_t i = 0; i + 2 < values.size(); i += 3)
        out.push_back(vec3(values[i], values[i + 1], values[i + 2]));
    return out;
}

/// Values of the points that the cage uses.
std::vector<float> cageValues(const SubdivCage& cage, const float* values, int components) {
    std::vector<float> out(cage.points.size() * components);
    for (size_t i = 0; i < cage.points.size(); ++i)
        std::copy_n(values + size_t(cage.points[i]) * components, components, &out[i * components]);
    return out;
}

/// Normals from limit tangents; where those vanish, of the triangles around.
std::vector<vec3> limitNormals(const LimitPoints& limit, const std::vector<vec3>& positions,
                               const std::vector<uvec3>& triangles, bool flip) {
    const std::vector<vec3> t1 = toVectors(limit.tangents1), t2 = toVectors(limit.tangents2);
    std::vector<vec3> normals(t1.size());
    std::vector<vec3> smooth;
    for (size_t i = 0; i < normals.size(); ++i) {
        const vec3 n = flip ? glm::cross(t2[i], t1[i]) : glm::cross(t1[i], t2[i]);
        const float length = glm::length(n);
        // Nearly parallel tangents say nothing about the normal.
        if (length > 1e-5f * glm::length(t1[i]) * glm::length(t2[i]) && length > 0.0f) {
            normals[i] = n / length;
            continue;
        }
        if (smooth.empty()) smooth = smoothNormals(positions, triangles);
        normals[i] = smooth[i];
    }
    return normals;
}

std::vector<CagePrimvar> cagePrimvars(const Mesh& mesh, const CageFaces& faces, size_t pointCount,
                                      const SubdivCage& cage,
                                      std::vector<FaceVaryingChannel>& channels,
                                      Diagnostics& diagnostics) {
    ElementCounts counts;
    counts.uniform = faces.authoredFaces;
    counts.varying = counts.vertex = pointCount;
    counts.faceVarying = faces.authoredCorners;
    std::vector<CagePrimvar> result;
    for (const Primvar& primvar : mesh.primvars) {
        CagePrimvar item;
        item.primvar = &primvar;
        if (primvar.name == "normals" ||
            !expandPrimvar(primvar, counts, mesh.path, diagnostics, item.values))
            continue;
        if (primvar.interpolation == Interpolation::FaceVarying) {
            item.channel = int(channels.size());
            static const std::vector<int> none;
            const bool indexed = primvar.indices.size() == counts.faceVarying;
            channels.push_back(mergeCornerValues(cage, item.values, primvar.components,
                                                 indexed ? primvar.indices : none));
            item.values.clear();
        }
        result.push_back(std::move(item));
    }
    return result;
}

MeshAttribute refineAttribute(const Far::TopologyRefiner& refiner, const SubdivCage& cage,
                              const LastLevel& last, const DrawnTriangles& drawn, CagePrimvar& item,
                              std::vector<FaceVaryingChannel>& channels) {
    const int n = item.primvar->components;
    MeshAttribute out;
    out.name = item.primvar->name;
    out.components = n;
    switch (item.primvar->interpolation) {
    case Interpolation::Constant:
        out.rate = Rate::Constant;
        out.data = std::move(item.values);
        break;
    case Interpolation::Uniform:
        out.rate = Rate::PerFace;
        out.data = std::move(item.values);
        break;
    case Interpolation::Varying:
    case Interpolation::Vertex:
        out.rate = Rate::PerVertex;
        out.data = refineValues(refiner, cageValues(cage, item.values.data(), n), n,
                                item.primvar->interpolation == Interpolation::Vertex
                                    ? RefineMode::Vertex
                                    : RefineMode::Varying);
        break;
    case Interpolation::FaceVarying: {
        out.rate = Rate::PerCorner;
        const std::vector<float> values =
            refineValues(refiner, std::move(channels[item.channel].values), n,
                         RefineMode::FaceVarying, item.channel);
        const Far::TopologyLevel& level = refiner.GetLevel(refiner.GetMaxLevel());
        std::vector<int> indices;
        indices.reserve(last.vertices.size());
        for (int f = 0; f < level.GetNumFaces(); ++f) {
            const auto corners = level.GetFaceFVarValues(f, item.channel);
            indices.insert(indices.end(), corners.begin(), corners.end());
        }
        out.data = gatherCorners(drawn, values, indices, n);
        break;
    }
    }
    return out;
}

} // namespace

TriangleMesh drawSubdivided(const Mesh& mesh, PointSteps points, const CageFaces& faces, int level,
                            Diagnostics& diagnostics) {
    const SubdivCage cage = makeSubdivCage(mesh, faces, points.count(), diagnostics);
    std::vector<FaceVaryingChannel> channels;
    std::vector<CagePrimvar> primvars =
        cagePrimvars(mesh, faces, points.count(), cage, channels, diagnostics);
    const auto refiner =
        cage.counts.empty() ? nullptr : refineTopology(mesh, cage, channels, level, diagnostics);
    if (!refiner)
        return drawPolygons(mesh, std::move(points), faces, CageNormals::Smooth, diagnostics);

    const bool smooth = mesh.scheme != SubdivisionScheme::Bilinear;
    const LastLevel last = lastLevel(*refiner, cage);
    TriangleMesh out;
    out.refineLevel = level;
    DrawnTriangles drawn;
    bool sharp = false;
    for (const auto& step : points.steps) {
        const LimitPoints limit = refinePoints(*refiner, cageValues(cage, &step[0].x, 3));
        out.positions.push_back(toVectors(limit.positions));
        if (out.positions.size() == 1) {
            drawn = drawFaces(last.faces, last.vertices, out.positions[0], mesh.leftHanded);
            sharp = smooth && hasSharpFeatures(refiner->GetLevel(level));
        }
        if (!smooth) continue;
        std::vector<vec3> normals =
            limitNormals(limit, out.positions.back(), drawn.triangles, mesh.leftHanded);
        if (sharp)
            normals = sharpNormals(refiner->GetLevel(level), drawn, last.faces.firstCorner,
                                   out.positions.back(), normals, mesh.leftHanded);
        out.normals.push_back(std::move(normals));
    }
    out.normalRate = sharp ? Rate::PerCorner : Rate::PerVertex;
    for (CagePrimvar& item : primvars)
        out.attributes.push_back(refineAttribute(*refiner, cage, last, drawn, item, channels));
    out.triangles = std::move(drawn.triangles);
    out.triangleFace = std::move(drawn.faces);
    finishMesh(mesh, diagnostics, out);
    return out;
}

} // namespace patina
