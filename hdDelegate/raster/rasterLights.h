#pragma once

#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/raster/glResources.h"
#include "hdDelegate/raster/rasterEmitters.h"
#include "hdDelegate/raster/rasterInstances.h"

#include <map>

namespace patina {

/// A light as shaders/raster/pass.glsl has it.
struct GpuLight {
    vec4 sampled, normal, radiance, origin, axis[3], inverse[3], shaping, focusTint, cone, shadow,
        shadowColor;
};

/// A view from a light, to be drawn into one shadow map.
struct ShadowView {
    mat4 worldToMap{1.0f};
    vec4 towards{0.0f}; ///< position of the light; direction to it where w is 0
};

/// Boxes that shadows are fitted to.
struct ShadowBounds {
    vec3 sceneMin{0.0f}, sceneMax{0.0f};       ///< all that casts
    vec3 receiverMin{0.0f}, receiverMax{0.0f}; ///< all that the camera sees
};

/// The lights of a scene, for passes that each take one sample of every light (more of the dome).
/// All pixels of a pass share the samples, so that a shadow map tells what they reach; passes add
/// up to soft shadows.
class RasterLights {
public:
    static constexpr int emitterSamples = 2; ///< of all glowing triangles together, per pass
    static constexpr int maxMaps = 32;   ///< shadow maps per pass; lights beyond are not shadowed
    static constexpr int maxLights = 64; ///< per pass; of more lights each pass takes a choice

    /// @param domeSamples per pass
    RasterLights(const SceneState& state, const RenderSettings& settings, RasterInstances& places,
                 float timeCode, int domeSamples, LightImages& images,
                 const std::map<std::string, int>& categories, Diagnostics& diagnostics);

    /// Samples of a pass.
    /// @param shadows receives the views; they have the order of the layers of the shadow maps
    std::vector<GpuLight> sample(uint32_t pass, const RasterEmitters& emitters,
                                 const ShadowBounds& bounds, int mapSize,
                                 std::vector<ShadowView>& shadows) const;

    uint32_t seed() const { return _seed; }
    int domeSamples() const { return _domeSamples; }
    bool hasDome() const { return _dome >= 0; }
    vec3 domeRadiance() const;
    mat4 domeToWorld() const;
    bool domeVisible() const;
    const GlTexture& domeMap() const { return _domeMap; } ///< empty for a constant dome
    const GlTexture& domeDensity() const { return _domeDensity; }

private:
    enum Kind { Rect, Disk, Sphere, Cylinder, Point, Distant, Dome, MoreDome, OtherDome, Triangle };
    struct Source {
        Kind kind = Point;
        GpuLight fixed;
        AreaShape shape;
        vec3 radiance{0.0f}, position{0.0f}, toLight{0.0f};
        float halfAngle = 0.0f;
        bool delta = false, shadows = true;
        mat3 domeToWorld{1.0f};
        std::shared_ptr<const EnvironmentMap> environment;
        bool cameraVisible = true;
    };

    void add(const Light& light, const mat4& toWorld, LightImages& images,
             const std::map<std::string, int>& categories, Diagnostics& diagnostics);
    void uploadDome();
    GpuLight draw(const Source& source, vec2 u) const;
    void castShadow(GpuLight& light, float turn, const ShadowBounds& bounds, int mapSize,
                    std::vector<ShadowView>& shadows) const;

    std::vector<Source> _sources;
    int _dome = -1, _domeSamples = 1;
    uint32_t _seed = 0;
    bool _shadows = true;
    GlTexture _domeMap, _domeDensity;
};

} // namespace patina
