// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/screenMotion.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/raster/scene/rasterScene.h"

#include <map>

namespace patina {

/// How what pixels show moves in the image, for the AOVs of motion: prims as they are placed. Their
/// own points stand still.
class RasterMotion {
public:
    /// @param scene,camera that the pixels were drawn of
    /// @param aovs of the film
    RasterMotion(const RasterScene& scene, const RasterCamera& camera,
                 const std::vector<AovSpec>& aovs);

    /// @param ids of aovs.frag.glsl
    /// @param position in the space of the scene's origin
    /// @returns false where it is not known
    bool way(const int* ids, const vec3& position, ScreenMotion::Moment moment, float out[2]) const;

private:
    struct Prim {
        dmat4 toGroup[3], fromWhereSeen;
        const std::vector<RasterPlace>* places[3];
        const std::vector<RasterPlace>* seen; ///< places as the pixels show them
    };

    ScreenMotion _screen;
    std::vector<std::unique_ptr<RasterInstances>> _instances;
    std::map<int, Prim> _prims; ///< by primId
};

} // namespace patina
