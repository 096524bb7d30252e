// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/lightEmitter.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/lights/lightTree.h"
#include "hdDelegate/scene/light.h"
#include "base/diagnostics.h"

#include <map>
#include <memory>
#include <vector>

namespace patina {

/// A light where it stands in the world. Lights of a prototype are listed once per instance.
struct LightInstance {
    std::shared_ptr<const Light> light;
    mat4 groupToWorld{1.0f}; ///< on top of the light's own transform
};

/// A triangle of a surface that glows. Its true radiance is the integrator's business.
struct LightTriangle {
    vec3 vertices[3]; ///< one-sided triangles shine where (v1 - v0) x (v2 - v0) points
    float luminance =
        1.0f; ///< estimate of the radiance that it emits; chooses how often it is sampled
    bool twoSided = false;
};

using LightTriangles = std::shared_ptr<const std::vector<LightTriangle>>;

/// Where the glowing triangles of a surface are. Places that share triangles share a light tree of
/// them, too.
struct LightTrianglePlace {
    LightTriangles triangles;
    mat4 toWorld{1.0f};  ///< invertible
    bool shared = false; ///< false: the triangles are in the world
    float factor = 1.0f; ///< of their luminances here
    int first = 0;       ///< triangles of the places before; LightSetInput::add() sets it
};

/// Everything that a LightSet is built from.
struct LightSetInput {
    std::vector<LightInstance> lights; ///< mesh lights may be in the list; they are left out here
    std::vector<LightTrianglePlace> glowing;
    int triangleCount = 0; ///< of all places together

    void add(LightTrianglePlace place) {
        place.first = triangleCount;
        triangleCount += int(place.triangles->size());
        glowing.push_back(std::move(place));
    }
    float shutterOpen = 0.0f, shutterClose = 0.0f; ///< time codes relative to the frame
    dvec3 origin{0.0}; ///< of the space that all places are in; lights of prototypes are in it by
                       ///< their groupToWorld
};

/// A direction in which light comes to a point.
struct LightSample {
    vec3 direction{0.0f};  ///< unit, from the point to the light
    float distance = 0.0f; ///< infinity for lights at infinity
    vec3 radiance{
        0.0f}; ///< that arrives; 1 for triangles; for delta lights the irradiance on a facing plane
    float pdf =
        0.0f; ///< solid angle density, selection included; of delta lights the selection alone
    bool delta = false;      ///< no ray can find it
    int light = -1;          ///< index, see LightSet
    vec3 normal{0.0f};       ///< of the light's surface, zero where it has none
    int triangle = -1;       ///< number among those of all LightSetInput::glowing, or -1
    vec2 barycentrics{0.0f}; ///< weights of vertices 1 and 2 of the triangle
    vec3 local{0.0f};        ///< direction in the frame of a dome
};

/// A light sample that has been begun: the light is chosen.
struct LightDraw {
    int light = -1; ///< none found
    float selection = 0.0f;
    EmitterDraw emitter;
};

/// An area light met by a ray. Not initialised: rays have room for several, and most meet none.
struct LightHit {
    int light;
    float distance; ///< along the ray
    vec3 position, normal;
    vec3 radiance; ///< against the ray's direction
};

/// All lights of a scene during one shutter. Immutable, so threads share it; equal inputs give
/// equal results. Light index i < lightCount() is LightSetInput::lights[i]; index lightCount() + t
/// is triangle t, counted through all places of LightSetInput::glowing. Lights without effect (zero
/// power, no size, broken transforms) keep their index, but are never sampled or hit.
///
/// A light tree chooses one light (Conty Estevez and Kulla 2018), with lights at infinity beside
/// the tree; then a direction towards it is drawn. The pdf functions give the density with which
/// sample(), with the same point, normal and time, would have found a direction, for multiple
/// importance sampling.
class LightSet {
public:
    LightSet(LightSetInput input, LightImages& images, Diagnostics& diagnostics);

    bool empty() const { return _tree.empty() && _infinite.empty(); }
    /// Whether any area light can be met by a ray.
    bool hasIntersectable() const { return _hasIntersectable; }
    int lightCount() const { return _lightCount; }
    /// Domes, and distant lights of more than a point.
    const std::vector<int>& infiniteLights() const { return _visibleInfinite; }

    /// @param normal side of the surface that light is wanted from, unit; zero where there is none
    /// @param twoSided light from the other side matters as well
    /// @param u uniform in [0,1): x, y place the sample, z chooses the light
    /// @returns false when no light was found; that counts as a sample of zero
    bool sample(const vec3& point, const vec3& normal, bool twoSided, const vec3& u, float time,
                LightSample& out) const;
    /// The same in three steps, for who has something else to do while memory is read: what one
    /// step reads is asked for by the step before. After sample() the radiance lacks image().
    LightDraw begin(const vec3& point, const vec3& normal, bool twoSided, const vec3& u,
                    float time) const;
    bool sample(const LightDraw& draw, const vec3& point, const vec3& normal, bool twoSided,
                float time, LightSample& out) const;
    vec3 image(const LightSample& sample) const {
        return sample.triangle < 0 ? _emitters[size_t(sample.light)].image(sample.local)
                                   : vec3(1.0f);
    }

    /// The share of a light that its filters leave, which intersect() and environment() do not know
    /// of.
    /// @param distance infinite for lights at infinity
    vec3 filtered(int light, const vec3& point, const vec3& direction, float distance,
                  float time) const {
        return light < _lightCount
                   ? _emitters[size_t(light)].filtered(point, direction, distance, time)
                   : vec3(1.0f);
    }

    /// Area lights between `near` and `far` that shine towards the ray's origin, in no order.
    /// @returns how many; of more than maxHits the nearest ones
    int intersect(const vec3& origin, const vec3& direction, float near, float far, float time,
                  LightHit* hits, int maxHits) const;

    /// Density of an area light that a ray hit.
    /// @param point where the ray's path comes from: sample()'s point
    float pdf(int light, const vec3& point, const vec3& normal, bool twoSided, float time,
              const LightHit& hit) const;
    /// Density of a place() on a light at infinity.
    float pdfInfinite(int light, const vec3& point, const vec3& normal, bool twoSided,
                      const EnvironmentMap::Place& place, float time) const;
    /// Density of a position on a triangle. @param triangle as LightSample has it
    float pdfTriangle(int triangle, const vec3& point, const vec3& normal, bool twoSided,
                      const vec3& position) const;

    /// Where on a light at infinity a direction leads.
    EnvironmentMap::Place place(int light, const vec3& direction, float time) const {
        return _emitters[size_t(light)].place(direction, time);
    }
    /// Radiance that arrives from a place on a light at infinity.
    vec3 environment(int light, const EnvironmentMap::Place& place, float time) const;
    /// Sum over all lights at infinity.
    vec3 environment(const vec3& direction, float time) const;

    /// The index in LightSetInput::glowing of the place that a triangle is in.
    int placeOf(int triangle) const {
        return indexBelow(triangle, [this](size_t i) { return _input.glowing[i].first; });
    }
    const LightTrianglePlace& glowing(int place) const { return _input.glowing[size_t(place)]; }

    /// Probability with which sample() chooses a light.
    float selectionProbability(int light, const vec3& point, const vec3& normal,
                               bool twoSided) const;

private:
    /// Chances of the lights at infinity and of the tree at one point.
    struct Choice {
        float tree = 0.0f, total = 0.0f; ///< estimates of irradiance
        int count = 0;                   ///< candidates; the tree is one
    };

    /// What the tree knows of a place: its triangles, or all of them together where they are
    /// shared.
    struct Glow {
        int tree = -1; ///< of shared triangles, in _shared
        mat4 toLocal{1.0f};
        mat3 normalToLocal{1.0f};
        int id = 0; ///< in _tree, beyond the lights; those of further triangles follow
    };
    struct Located {
        vec3 point, normal;
    };

    void addPlace(const LightTrianglePlace& place, std::map<const void*, int>& known,
                  std::vector<LightTreeLeaf>& leaves);
    static bool addTriangle(const LightTriangle& triangle, int id,
                            std::vector<LightTreeLeaf>& leaves);
    /// A point and normal as a shared tree has them.
    static Located located(const Glow& glow, const vec3& point, const vec3& normal);
    LightTriangle triangleInWorld(int triangle) const;
    int chooseInTree(const vec3& point, const vec3& normal, bool twoSided, float u,
                     float& probability) const;
    float probabilityInTree(int light, const vec3& point, const vec3& normal, bool twoSided) const;
    /// The last i whose first(i) is at most n, of ascending ones.
    template <class First> int indexBelow(int n, const First& first) const {
        size_t low = 0, high = _input.glowing.size();
        while (high - low > 1) {
            const size_t middle = (low + high) / 2;
            (first(middle) <= n ? low : high) = middle;
        }
        return int(low);
    }
    Choice makeChoice(const vec3& point, const vec3& normal, bool twoSided) const;
    float share(const Choice& choice, float weight) const;
    bool sampleTriangleLight(int triangle, const vec3& point, const vec2& u, float selection,
                             LightSample& out) const;

    LightSetInput _input;
    int _lightCount = 0;
    std::vector<LightEmitter> _emitters; ///< per light
    std::vector<int> _infinite;          ///< emitters at infinity, delta ones too
    std::vector<int> _visibleInfinite;
    std::vector<Glow> _glows;       ///< per place of LightSetInput::glowing
    std::vector<LightTree> _shared; ///< of triangles in the space that they are shared in
    LightTree _tree;                ///< leaf ids are lights, then as Glow::id says
    bool _hasIntersectable = false;
};

} // namespace patina
