#pragma once

#include "hdDelegate/raster/rasterCamera.h"
#include "hdDelegate/raster/rasterInstances.h"
#include "hdDelegate/scene/geometry.h"

namespace patina {

/// What of a prim's size tells how finely it is drawn. Object space.
struct RasterExtent {
    vec3 low{0.0f}, high{0.0f};
    float area = 0.0f;    ///< of the cage of a subdivision surface
    bool refines = false; ///< it can be drawn more or less finely

    RasterExtent() = default;
    explicit RasterExtent(const Geometry& prim);
    /// The most triangles that edges of so many object units are asked for: those of that length.
    /// Uniform refinement by the longest edge alone would make most of a mesh needlessly fine.
    size_t trianglesFor(float edge) const;
};

/// How finely a prim is drawn, by its size on screen.
class RasterDetail {
public:
    /// Edges may be twice as long as the settings ask for unless the prim is displaced: normals
    /// are smooth, and a chord of e pixels leaves a circle of R pixels by e^2 / 8R, less than a
    /// tenth where R is above 80 (e = 8).
    RasterDetail(const RasterExtent& extent, const MotionTransform& transform,
                 const RasterCamera& camera, const RenderSettings& settings, bool displaced);

    /// The longest edge, in object units, that looks as long from the camera as the settings ask
    /// for: a power of two, so that few of them differ. 0: the prim is not refined.
    float edgeAt(const RasterPlace& place) const;

private:
    mat4 _toGroup{1.0f};
    vec3 _center{0.0f};
    float _radius = 0.0f, _edge = 0.0f, _nearest = 0.0f;
    RasterView _view;
};

} // namespace patina
