// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/linkNames.h"
#include "hdDelegate/lights/areaShape.h"
#include "hdDelegate/raster/lights/lightCells.h"
#include "hdDelegate/raster/lights/rasterDomes.h"
#include "hdDelegate/raster/lights/rasterEmitters.h"
#include "hdDelegate/raster/lights/rasterLight.h"
#include "hdDelegate/raster/lights/rasterLightFilters.h"
#include "hdDelegate/raster/lights/rasterLightTables.h"
#include "hdDelegate/raster/scene/rasterInstances.h"

#include <algorithm>
#include <map>
#include <set>

namespace patina {

/// The lights of a scene, for passes that each take one sample of every light (more of domes). All
/// pixels of a pass share the samples, so a shadow map can tell which points a sample reaches.
/// Passes add up to soft shadows. If a pass has no room for the shadow maps of all lights, it takes
/// some of the lights. These count more, so that the mean of the passes is right.
class RasterLights {
public:
    static constexpr int minEmitterSamples = 2; ///< of all glowing triangles together, per pass
    static constexpr int maxEmitterSamples = 5; ///< where lights leave room for their shadows
    static constexpr int maxCoarseSamples = 16; ///< in small images, by maps of half the size
    static constexpr int maxMaps = 32;          ///< shadow maps per pass in the full size
    static constexpr int maxSmallMaps = 128;    ///< in half of it, where lights need more
    static constexpr int maxTinyMaps = 512;     ///< smaller still, for as few pixels a side
    static constexpr int maxManyMaps = 1280;    ///< where pixels choose among lights
    static constexpr int leastManyMap = 128;    ///< texels along their sides
    /// Lights at places, from this number on, among which pixels choose; see LightCells.
    static constexpr int many = 17;
    static constexpr int chosen = 4;         ///< of them by a pixel in a pass
    static constexpr int texelsPerPixel = 4; ///< along a side of a map, and of the image
    static constexpr int smallestMap = 256;  ///< what casts is no coarser in small images
    static constexpr int maxUnshadowed = 64; ///< lights without shadows per pass
    static constexpr int maxDomes = 24;      ///< per pass
    static constexpr int lookEvery = 8;      ///< of a light's samples a pixel takes one in
    static constexpr int maxTaken = 208;     ///< samples per pass, see Lights in lights.glsl

    /// @param domeSamples per pass, where domes are sampled
    /// @param domeMethods of `domeLight`, by which materials are drawn
    /// @param links that prims were given numbers by
    /// @param pixelsChoose whether pixels choose among the lights, and programs know that
    RasterLights(const SceneState& state, const RenderSettings& settings, RasterInstances& places,
                 float timeCode, int domeSamples, const std::set<std::string>& domeMethods,
                 LightImages& images, RasterDomes& domes, const LinkNames& links,
                 Diagnostics& diagnostics, bool pixelsChoose = false);

    /// The lights as a pass knows them.
    struct Sampled {
        std::vector<GpuLight> lights; ///< taken ones first, then those that are only looked at
        int taken = 0;
        std::vector<vec4> tables;        ///< see RasterLightTables::writePass()
        std::vector<ShadowView> shadows; ///< in the order of the layers of the shadow maps
        int mapSize = 0;
        bool fibres = false; ///< lights have maps for fibres, too
        /// Which lights are for what, see passFields.glsl.
        int found = 0, firstSampled = 0, firstShared = 0, sharedEvery = 1;
        /// Where pixels choose among the lights from firstShared on: of those, by their numbers.
        std::vector<LightEstimate> estimates;
        LightCells cells;
        bool many = false; ///< of a first look: all lights have as many samples as help
    };
    /// For a first look: many samples of each light, of which every pixel takes others than its
    /// neighbours, so that what is wrong is noise and not the same everywhere.
    /// @param maximum shadow maps that may be drawn; where they do not suffice, lights are as in
    /// sample()
    /// @param most as in sample()
    Sampled sampleLook(uint32_t pass, const RasterEmitters& emitters, const ShadowBounds& bounds,
                       int mapSize, int pixels, int maximum, int most = maxSmallMaps) const;
    /// For the first image where maps are too dear for that: light by as many samples, shadows of
    /// domes by the cells of the sky, and of other lights by the maps of few of their samples. It
    /// is not right in the mean where there are shadows, so nothing of it may stay.
    /// @returns nothing taken where there is no room even for that
    Sampled sampleFirst(const RasterEmitters& emitters, const ShadowBounds& bounds, int mapSize,
                        int pixels, int maximum) const;
    /// @param mapSize of shadow maps, when there are not too many
    /// @param pixels along the longer side of the image
    /// @param most shadow maps that may be drawn where pixels choose among lights
    Sampled sample(uint32_t pass, const RasterEmitters& emitters, const ShadowBounds& bounds,
                   int mapSize, int pixels, int most = maxSmallMaps) const;

    uint32_t seed() const { return _seed; }
    /// Every pass has Sampled::cells then, with empty lists where no light is at a place.
    bool pixelsChoose() const { return _pixelsChoose; }
    /// Whether every material takes samples of domes: first looks are no part of the other methods.
    bool samplesDomes() const {
        return _domeMethods.size() == _domeMethods.count("sampled") || !_hasDome;
    }
    /// Whether shadows are asked for in directions that are no light's samples.
    bool needsSky() const { return _shadows && (_hasDome || _hasWideSun); }
    /// Pixels may be negative.
    bool takeAway() const { return _takeAway; }
    const RasterLightTables& tables() const { return _tables; }
    const RasterLightFilters& filters() const { return _filters; }
    static constexpr int maxTables = ///< values of a pass in tables
        maxCoarseSamples * RasterEmission::maxValues;

private:
    /// Those of AreaShape, and of shaders/lights/kinds.glsl:
    enum Kind {
        Point = shLights::LIGHT_POINT,
        Distant = shLights::LIGHT_DISTANT,
        Dome = shLights::LIGHT_DOME,
        MoreDome = shLights::LIGHT_MORE_DOME,
        Line = shLights::LIGHT_LINE,
        Triangle = shLights::LIGHT_TRIANGLE,
    };
    struct Source {
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
    };

    /// @param filters of it in the tables; -1: it has none
    void add(const Light& light, const mat4& toWorld, int filters, const RenderSettings& settings,
             LightImages& images, RasterDomes& domes, const LinkNames& links,
             Diagnostics& diagnostics);
    void warnOfDomeMethods(const Light& light, Diagnostics& diagnostics) const;
    bool addDome(Source& source, const Light& light, LightImages& images, RasterDomes& domes);
    void addShape(Source& source, const Light& light, LightImages& images,
                  Diagnostics& diagnostics);
    /// @param u in the unit cube; the third number is for sphere lights
    GpuLight draw(const Source& source, const vec3& u) const;
    /// @param mapped samples that have shadow maps of their own
    void addLook(const Source& source, size_t number, uint32_t pass, int samples, int mapped,
                 const ShadowBounds& bounds, int maximum, Sampled& out,
                 std::vector<GpuLight>& looked, std::vector<GpuLight>& shared,
                 std::vector<GpuLight>& pool) const;
    int lookSamples(const Source& source) const;
    static void join(Sampled& out, const std::vector<GpuLight>& looked,
                     const std::vector<GpuLight>& shared, std::vector<GpuLight> pool);
    int mapsOf(const Source& source, const ShadowBounds& bounds) const;
    static int enoughFor(int pixels, int mapSize);
    void choosePerPixel(uint32_t pass, const ShadowBounds& bounds,
                        const std::vector<std::pair<GpuLight, size_t>>& placed, Sampled& out) const;
    std::vector<std::pair<size_t, float>> choose(uint32_t pass, const ShadowBounds& bounds,
                                                 int room, int emitterSamples) const;
    void takeEmitters(uint32_t pass, int samples, const RasterEmitters& emitters,
                      const ShadowBounds& bounds, int maximum, Sampled& out) const;
    /// @param maximum maps that there is room for; a light that needs more is not shadowed
    void castShadow(GpuLight& light, int category, vec2 turn, const ShadowBounds& bounds,
                    int maximum, Sampled& out) const;
    /// @returns how many maps show the receivers; 0 without room
    int castOnto(const GpuLight& light, int category, vec2 turn, const ShadowBounds& bounds,
                 int maximum, Sampled& out) const;

    RasterLightTables _tables;
    RasterLightFilters _filters;
    std::vector<Source> _sources;
    std::set<std::string> _domeMethods;
    int _domeSamples = 1; ///< 0: no material looks at samples of domes
    uint32_t _seed = 0;
    bool _shadows = true, _hasDome = false, _hasWideSun = false, _takeAway = false;
    bool _pixelsChoose = false;
    static constexpr float narrowSun = 0.003f; ///< see lighting.frag.glsl
};

} // namespace patina
