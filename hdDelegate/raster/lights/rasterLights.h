// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/linkNames.h"
#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/raster/lights/lightEstimate.h"
#include "hdDelegate/raster/lights/rasterDomes.h"
#include "hdDelegate/raster/lights/rasterLightFilters.h"

#include <set>

namespace patina {

/// A light in one place.
struct RasterLightSource {
    /// Those of AreaShape, and of shaders/lights/kinds.glsl:
    enum Kind {
        Point = shLights::LIGHT_POINT,
        Distant = shLights::LIGHT_DISTANT,
        Dome = shLights::LIGHT_DOME,
        Line = shLights::LIGHT_LINE,
    };
    Kind kind = Point;
    GpuLight fixed;
    AreaShape shape;
    vec3 radiance{0.0f}, position{0.0f}, toLight{0.0f};
    float weight = 0.0f; ///< rough luminous power, for choosing among lights
    float extent = 0.0f; ///< radius about `position` that samples may come from
    bool delta = false, shadows = true;
    int shadowCategory = -1;
    mat3 domeToWorld{1.0f};
    vec3 sunDirection{0.0f}, sunIrradiance{0.0f}; ///< of a dome, in its frame
    std::shared_ptr<const EnvironmentMap> environment;
    const RectImage* image = nullptr;
    LightEstimate estimate;

    bool atPlace() const { return kind != Dome && kind != Distant; }
    /// @param u in the unit cube; the third number is for sphere lights
    GpuLight sample(const vec3& u) const;
};

/// The lights of a scene.
class RasterLights {
public:
    /// @param domeSamples per pass, where domes are sampled
    /// @param domeMethods of `domeLight`, by which materials are drawn
    /// @param links that prims were given numbers by
    /// @param pixelsChoose whether pixels choose among the lights, and programs know that
    RasterLights(const SceneState& state, const RenderSettings& settings, RasterInstances& places,
                 float timeCode, int domeSamples, const std::set<std::string>& domeMethods,
                 LightImages& images, RasterDomes& domes, const LinkNames& links,
                 Diagnostics& diagnostics, bool pixelsChoose = false);

    const std::vector<RasterLightSource>& sources() const { return _sources; }
    int domeSamples() const { return _domeSamples; } ///< 0: no material looks at samples of domes
    bool castShadows() const { return _shadows; }
    uint32_t seed() const { return _seed; }
    /// Every pass has SampledLights::cells then, with empty lists where no light is at a place.
    bool pixelsChoose() const { return _pixelsChoose; }
    /// Whether every material takes samples of domes: previews are no part of the other methods.
    bool samplesDomes() const {
        return _domeMethods.size() == _domeMethods.count("sampled") || !_hasDome;
    }
    /// Whether shadows are asked for in directions that are no light's samples.
    bool needsSky() const { return _shadows && (_hasDome || _hasWideSun); }
    /// Pixels may be negative.
    bool takeAway() const { return _takeAway; }
    const RasterLightTables& tables() const { return _tables; }
    const RasterLightFilters& filters() const { return _filters; }

private:
    /// @param filters of it in the tables; -1: it has none
    void add(const Light& light, const mat4& toWorld, int filters, const RenderSettings& settings,
             LightImages& images, RasterDomes& domes, const LinkNames& links,
             Diagnostics& diagnostics);
    void warnOfDomeMethods(const Light& light, Diagnostics& diagnostics) const;
    bool addDome(RasterLightSource& source, const Light& light, LightImages& images,
                 RasterDomes& domes);
    void addShape(RasterLightSource& source, const Light& light, LightImages& images,
                  Diagnostics& diagnostics);

    RasterLightTables _tables;
    RasterLightFilters _filters;
    std::vector<RasterLightSource> _sources;
    std::set<std::string> _domeMethods;
    int _domeSamples = 1;
    uint32_t _seed = 0;
    bool _shadows = true, _hasDome = false, _hasWideSun = false, _takeAway = false;
    bool _pixelsChoose = false;
    static constexpr float narrowSun = 0.003f; ///< see lighting.frag.glsl
};

} // namespace patina
