// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/lights/skyDistribution.h"
#include "hdDelegate/scene/types.h"

#include <memory>
#include <string>

namespace patina {

/// How an image lies around a dome (UsdLux texture:format).
enum class EnvironmentFormat { Automatic, Latlong, MirroredBall, Angular, CubeMapVerticalCross };
/// Unknown names are automatic: a vertical cross when the image is 3 wide and 4 high, else latlong.
EnvironmentFormat environmentFormat(const std::string& name);

/// An image that surrounds the scene, with a density for samples.
///
/// Directions are in the dome's frame: y is the pole. All formats have +z in their middle and -x at
/// their right, as in OpenEXR's latlong:
/// - latlong: longitude 0 is +z, longitude pi/2 is +x, and the left edge has longitude pi.
/// - mirrored ball: the reflection that a distant viewer of a mirror ball sees, with +z in the
///   middle.
/// - angular: the same with the radius proportional to the angle.
/// - cross: rows (. +y .), (+x +z -x), (. -y .), (. -z .), the last upside down.
///
/// Radiance is the bilinear interpolation of the texels. The density is constant over cells of a
/// latlong grid, follows the cosine as well (SkyDistribution), and covers the neighbours into which
/// bilinear interpolation spreads light.
class EnvironmentMap {
public:
    EnvironmentMap(std::shared_ptr<const ImageRGB> image, EnvironmentFormat format);

    bool black() const { return _distribution.empty(); }
    vec3 radiance(const vec3& direction) const;

    /// A direction, with what both radiance and density need of it.
    struct Place {
        vec3 direction{0.0f};
        float u = 0.0f, v = 0.0f; ///< longitude and polar angle, 0..1
    };
    /// The texels and what else there is to be read are on their way into the cache afterwards.
    Place place(const vec3& direction) const;
    vec3 radiance(const Place& place) const;
    float pdf(const Place& place, const vec3& normal, bool twoSided) const;

    int width() const { return _image->width; } ///< texels of the image as it lies in the file
    int height() const { return _image->height; }
    vec3 mean() const { return _mean; } ///< of the radiance over the sphere

    /// @param pdf receives the density over solid angle
    /// @param normal of the surface that is lit, unit, in the dome's frame; zero: there is none
    /// @param twoSided light from below the surface counts as well
    vec3 sample(const vec2& u, float& pdf, const vec3& normal = vec3(0.0f),
                bool twoSided = false) const;
    /// The same in two steps, for who has something else to do while memory is read. The texels of
    /// the sample are on their way into the cache after the second.
    SkyDistribution::Draw begin(const vec2& u, const vec3& normal, bool twoSided) const {
        return _distribution.begin(u, normal, twoSided);
    }
    vec3 sample(const SkyDistribution::Draw& draw, float& pdf) const;
    float pdf(const vec3& direction, const vec3& normal = vec3(0.0f), bool twoSided = false) const;

private:
    void build();
    std::vector<vec3> latlongGrid(int width, int height) const;
    vec3 bilinear(float x, float y, bool wrap) const;
    vec3 bilinearIn(float x, float y, int x0, int y0, int x1, int y1) const;
    vec3 cross(const vec3& direction) const;
    void fetchTexels(float u, float v) const;
    glm::ivec2 cellAt(const Place& place) const;
    float bandHeight(int row) const; ///< difference of cos(theta) across a row

    std::shared_ptr<const ImageRGB> _image;
    EnvironmentFormat _format;
    SkyDistribution _distribution;
    std::vector<float> _cosines; ///< of the rows' edges
    vec3 _mean{0.0f};
};

} // namespace patina
