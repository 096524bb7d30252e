#pragma once

#include "hdDelegate/hydra/gprim.h"

#include <pxr/imaging/hd/mesh.h>

namespace patina {

/// Polygon meshes and subdivision surfaces with all their tags, geom subsets and primvars. The
/// display style's refine level is a floor of the refinement, its flat shading shows the cage with
/// face normals. Reprs make no difference: surfaces are drawn as surfaces.
class HdPatinaMesh final : public HdPatinaGprim<HdMesh, Mesh> {
public:
    using HdPatinaGprim::HdPatinaGprim;

protected:
    void syncShape(HdSceneDelegate& delegate, HdPatinaRenderParam& param, HdDirtyBits dirtyBits,
                   bool all, const TfToken& repr, Mesh& mesh) override;
    void setPoints(Mesh& mesh, Sampled<std::vector<vec3>> points) override {
        mesh.points = std::move(points);
    }

private:
    void readTopology(HdSceneDelegate& delegate, HdPatinaRenderParam& param, Mesh& mesh);
    void readTags(HdSceneDelegate& delegate, Mesh& mesh) const;

    SubdivisionScheme _authored = SubdivisionScheme::None; ///< before flat shading
};

} // namespace patina
