// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/measure/measuredSky.h"
#include "shaders/measure/reflector.h"

namespace patina::measure {

/// A lobe under a sky, without shadows, by each way of the choice point domeLight. The
/// work of shaders/raster/sky.glsl and lighting.frag.glsl stands here once more, in C++, with the
/// shipped lobes, harmonics and maps.
struct DomePoint {
    Reflector lobe;
    glm::vec3 x, y, normal; ///< the lobe's frame in the dome

    /// @param turn of the frame about the normal, radians
    DomePoint(const Reflector& reflector, const glm::vec3& n, float turn);

    glm::vec3 toDome(const glm::vec3& local) const {
        return x * local.x + y * local.y + normal * local.z;
    }
    glm::vec3 toLobe(const glm::vec3& d) const {
        return glm::vec3(glm::dot(x, d), glm::dot(y, d), glm::dot(normal, d));
    }
};

/// Light that a point gives off towards the viewer.
/// @param passes each of 4 directions of the sky and 2 samples of the material
double bySampling(const DomePoint& p, const MeasuredSky& sky, int passes, uint32_t seed);
/// One pass. @param samples of the material
double byFiltering(const DomePoint& p, const MeasuredSky& sky, int samples, uint32_t seed);
/// @param bare without a window and without the dominant light apart
double byHarmonics(const DomePoint& p, const MeasuredSky& sky, bool bare);
/// Mirrors alone.
double byPrefiltering(const DomePoint& p, const MeasuredSky& sky);

/// The sum over all texels of the sky.
double overTexels(const DomePoint& p, const MeasuredSky& sky);
/// The same for lobes that fall between texels: 4096 directions of the sky's density and as many of
/// the lobe's, weighted by the power heuristic (Veach 1997).
double overDrawn(const DomePoint& p, const MeasuredSky& sky);
/// One of both, by how wide the lobe is.
double domeTruth(const DomePoint& p, const MeasuredSky& sky);

} // namespace patina::measure
