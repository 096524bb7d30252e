#pragma once

#include "hdDelegate/raster/rasterCamera.h"
#include "hdDelegate/raster/rasterInstances.h"
#include "hdDelegate/scene/geometry.h"

namespace patina {

/// How finely a prim is drawn, by its size on screen.
class RasterDetail {
public:
    /// Edges may be twice as long as the settings ask for unless the prim is displaced: normals
    /// are smooth, and a chord of e pixels leaves a circle of R pixels by e^2 / 8R, less than a
    /// tenth where R is above 80 (e = 8).
    RasterDetail(const Geometry& prim, const RasterCamera& camera, const RenderSettings& settings,
                 bool displaced);

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
