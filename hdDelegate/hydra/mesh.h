// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/gprim.h"

#include <pxr/imaging/hd/mesh.h>

namespace patina {

/// Polygon meshes and subdivision surfaces with all their tags, geom subsets and primvars; also
/// NURBS patches and meshes of tetrahedra, which UsdImaging hands on as grids and surfaces that
/// subdivide. The display style's refine level is a floor of the refinement, its flat shading shows
/// the cage with face normals. Reprs make no difference: surfaces are drawn as surfaces.
class HdPatinaMesh final : public HdPatinaGprim<HdMesh, Mesh> {
public:
    using HdPatinaGprim::HdPatinaGprim;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Mesh& mesh) override;
    void setPoints(Mesh& mesh, Sampled<std::vector<vec3>> points) override {
        mesh.points = std::move(points);
    }
    std::shared_ptr<const Geometry> shownAs(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                                            const std::shared_ptr<const Mesh>& mesh) const override;

private:
    void readTopology(HdSceneDelegate& delegate, HdPatinaRenderParam& param, Mesh& mesh);
    void readTags(HdSceneDelegate& delegate, Mesh& mesh) const;

    SubdivisionScheme _authored = SubdivisionScheme::None; ///< before flat shading
    std::vector<int> _tets, _surface; ///< of a mesh of tetrahedra; empty of others
};

} // namespace patina
