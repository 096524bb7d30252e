// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/mesh.h"

#include "hdDelegate/hydra/materialBinding.h"
#include "hdDelegate/hydra/sourceForms.h"

#include <pxr/imaging/hd/meshTopology.h>
#include <pxr/imaging/pxOsd/tokens.h>

#include <algorithm>

namespace patina {

namespace {

SubdivisionScheme schemeOf(const TfToken& scheme) {
    if (scheme == PxOsdOpenSubdivTokens->catmullClark) return SubdivisionScheme::CatmullClark;
    if (scheme == PxOsdOpenSubdivTokens->loop) return SubdivisionScheme::Loop;
    if (scheme == PxOsdOpenSubdivTokens->bilinear) return SubdivisionScheme::Bilinear;
    return SubdivisionScheme::None;
}

/// Rules that are not authored are those of UsdGeomMesh.
void setRule(const TfToken& token, const std::string& fallback, std::string& rule) {
    rule = token.IsEmpty() ? fallback : token.GetString();
}

} // namespace

void HdPatinaMesh::syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                             HdDirtyBits dirtyBits, bool all, const TfToken&, Mesh& mesh) {
    const SdfPath& id = GetId();
    // Attributes of a source form are among the primvars.
    if (all || HdChangeTracker::IsTopologyDirty(dirtyBits, id) ||
        ((mesh.patch || !_tets.empty()) && HdChangeTracker::IsAnyPrimvarDirty(dirtyBits, id)))
        readTopology(delegate, param, mesh);
    if (all || HdChangeTracker::IsSubdivTagsDirty(dirtyBits, id)) readTags(delegate, mesh);
    if (all || HdChangeTracker::IsDisplayStyleDirty(dirtyBits, id) ||
        HdChangeTracker::IsTopologyDirty(dirtyBits, id)) {
        const HdDisplayStyle style = delegate.GetDisplayStyle(id);
        mesh.refineLevel = style.refineLevel;
        mesh.scheme = style.flatShadingEnabled ? SubdivisionScheme::None : _authored;
    }
}

void HdPatinaMesh::readTopology(HdSceneDelegate& delegate, HdPatinaRenderParam& param, Mesh& mesh) {
    const HdMeshTopology topology = delegate.GetMeshTopology(GetId());
    _authored = schemeOf(topology.GetScheme());
    mesh.scheme = _authored;
    mesh.leftHanded = topology.GetOrientation() == PxOsdOpenSubdivTokens->leftHanded;
    mesh.faceVertexCounts = toVector(topology.GetFaceVertexCounts());
    mesh.faceVertexIndices = toVector(topology.GetFaceVertexIndices());
    mesh.holeIndices = toVector(topology.GetHoleIndices());
    for (const int face : topology.GetInvisibleFaces())
        mesh.holeIndices.push_back(face);
    mesh.patch = nullptr;
    _tets.clear();
    // UsdImaging makes subdivision surfaces of both.
    if (_authored == SubdivisionScheme::CatmullClark && !readPatch(delegate, GetId(), mesh))
        readTets(delegate, GetId(), _tets, _surface);
    mesh.subsets.clear();
    for (const HdGeomSubset& subset : topology.GetGeomSubsets()) {
        if (subset.type != HdGeomSubset::TypeFaceSet) {
            param.warn(subset.id, "elementType", messages::subsetNotFace);
            continue;
        }
        mesh.subsets.push_back({subset.id.GetString(),
                                materialOf(delegate, subset.id, subset.materialId).GetString(),
                                toVector(subset.indices)});
    }
    std::sort(mesh.subsets.begin(), mesh.subsets.end(),
              [](const GeomSubset& a, const GeomSubset& b) { return a.path < b.path; });
}

std::shared_ptr<const Geometry>
HdPatinaMesh::shownAs(HdSceneDelegate&, HdPatinaRenderParam& param,
                      const std::shared_ptr<const Mesh>& mesh) const {
    if (_tets.empty()) return mesh;
    TetMesh tets;
    static_cast<Mesh&>(tets) = *mesh;
    tets.tets = _tets;
    tets.surface = _surface;
    return surfaceOf(tets, param.scene()->diagnostics());
}

void HdPatinaMesh::readTags(HdSceneDelegate& delegate, Mesh& mesh) const {
    const PxOsdSubdivTags tags = delegate.GetSubdivTags(GetId());
    const Mesh fallback;
    setRule(tags.GetVertexInterpolationRule(), fallback.interpolateBoundary,
            mesh.interpolateBoundary);
    setRule(tags.GetFaceVaryingInterpolationRule(), fallback.faceVaryingLinearInterpolation,
            mesh.faceVaryingLinearInterpolation);
    setRule(tags.GetTriangleSubdivision(), fallback.triangleSubdivisionRule,
            mesh.triangleSubdivisionRule);
    mesh.creaseIndices = toVector(tags.GetCreaseIndices());
    mesh.creaseLengths = toVector(tags.GetCreaseLengths());
    mesh.creaseSharpnesses = toVector(tags.GetCreaseWeights());
    mesh.cornerIndices = toVector(tags.GetCornerIndices());
    mesh.cornerSharpnesses = toVector(tags.GetCornerWeights());
}

} // namespace patina
