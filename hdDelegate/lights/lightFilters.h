// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/image/imageTextureLoad.h"
#include "hdDelegate/scene/light.h"
#include "shaders/lights.h"

#include <memory>

namespace patina {

class LightImages;
class Diagnostics;

/// The filters of one light made ready: what they leave of it on its way to a point.
class LightFilters {
public:
    LightFilters() = default;
    /// Filters that cannot work are left out, and a warning names light and filter.
    /// @param groupToWorld,origin as of LightEmitter
    LightFilters(const Light& light, const mat4& groupToWorld, const dvec3& origin, float time,
                 LightImages& images, Diagnostics& diagnostics);

    bool empty() const { return _filters.empty(); }

    /// @param point that is lit, world space
    /// @param direction unit, towards the light
    /// @param distance of the light's point; infinite where the light is at infinity
    vec3 factor(const vec3& point, const vec3& direction, float distance, float time) const;

    /// Values between knots; outside of them the first and last one.
    struct Curve {
        std::vector<float> knots;
        std::vector<vec3> values;
        int kind = shLights::CURVE_LINEAR;
        vec3 at(float x) const;
    };
    struct Filter {
        LightFilterType type;
        MotionTransform transform;
        mat4 toFilter{1.0f}; ///< at the shutter's opening; scaled as the filter's shape is
        vec3 scale{1.0f};
        shLights::FilterBox box;
        bool analytic = false, directional = false, invert = false;
        vec2 shear{0.0f};
        float apex = 0.0f, density = 1.0f, intensity = 1.0f;
        int rampType = 0;
        float start = 0.0f, end = 1.0f;
        Curve ramp, colors;
        std::shared_ptr<const ImageRGB> image;
        shLights::FilterImage shown; ///< how the image lies in the plane
        vec3 fill{0.0f};

        /// Whether light that does not cross the plane gets `fill`, too.
        bool fillsBehind() const { return image && shown.wrap == shLights::IMAGE_OFF; }
    };
    const std::vector<Filter>& filters() const { return _filters; }

private:
    static Curve curveOf(const LightFilter& filter, bool colors, const std::string& light,
                         Diagnostics& diagnostics);
    static bool addImage(const LightFilter& from, const std::string& light, LightImages& images,
                         Diagnostics& diagnostics, Filter& to);
    mat4 toFilterAt(const Filter& filter, float time) const;
    vec3 factorOf(const Filter& filter, const vec3& point, const vec3& direction, float distance,
                  float time) const;
    static vec3 texel(const Filter& filter, const vec3& at);

    std::vector<Filter> _filters;
    mat4 _group{1.0f};
    dvec3 _origin{0.0};
};

} // namespace patina
