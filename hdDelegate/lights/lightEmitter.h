// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/domePortals.h"
#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/lights/lightFilters.h"
#include "hdDelegate/lights/lightTree.h"
#include "hdDelegate/lights/resolvedLight.h"

#include <memory>

namespace patina {

class LightImages;
class Diagnostics;

/// Light that comes from one emitter to one point.
struct EmitterSample {
    vec3 direction{0.0f}, normal{0.0f}, radiance{0.0f};
    float distance = 0.0f, pdf = 0.0f; ///< pdf of delta emitters is 1
    vec3 local{0.0f};                  ///< direction in the frame of a dome with an image
};

/// A sample that has been begun: of a dome with an image, that is where in the image.
struct EmitterDraw {
    vec2 u{0.0f};
    SkyDistribution::Draw sky;
    bool guided = false; ///< by a portal, in this direction
    vec3 direction{0.0f};
};

/// What a light reads from files, once for all places that it is drawn in.
struct LightFiles {
    bool read = false;
    std::shared_ptr<const IesProfile> profile;
    std::shared_ptr<const ImageRGB> texture;
    vec3 mean{1.0f}; ///< of the texture's pixels
};

/// One light made ready for sampling. Area lights sample points on their shape; points, lines and
/// distant lights of angle 0 are delta emitters that no ray can hit, see ResolvedLight.
class LightEmitter {
public:
    using Kind = ResolvedLight::Kind;

    LightEmitter() = default;
    /// A light that gives no light, for whatever reason, becomes Kind::None. Reasons that look
    /// like mistakes are warned about.
    /// @param origin of the space that the light's own transform is wanted in, see seenFrom()
    /// @param light kept
    /// @param files of this light, read here unless another of its places has read them
    LightEmitter(std::shared_ptr<const Light> light, const mat4& groupToWorld, const dvec3& origin,
                 float shutterOpen, float shutterClose, LightFiles& files, LightImages& images,
                 Diagnostics& diagnostics);

    /// Requests the memory that sample() reads of a light that is not at infinity.
    void request() const {
        const char* end = reinterpret_cast<const char*>(&_portals);
        for (auto at = reinterpret_cast<const char*>(this); at < end; at += 64)
            __builtin_prefetch(at);
    }

    Kind kind() const { return _resolved.kind; }
    bool atInfinity() const {
        return _resolved.kind == Kind::Distant || _resolved.kind == Kind::Dome;
    }
    bool delta() const { return _resolved.delta; }

    /// Samples are taken in three steps, because an image around the scene is larger than caches.
    /// Each step requests the memory that the next one reads.
    /// @param normal,twoSided as of LightSet::sample(); constant domes sample by the cosine
    EmitterDraw begin(const vec3& point, const vec3& normal, bool twoSided, const vec2& u,
                      float time) const;
    /// Goes on with the same normal, side and time. The radiance is filtered, and without image().
    bool sample(const EmitterDraw& draw, const vec3& point, const vec3& normal, bool twoSided,
                float time, EmitterSample& out) const;
    /// The share of the light that its filters let through to a point.
    vec3 filtered(const vec3& point, const vec3& direction, float distance, float time) const {
        return _filters.empty() ? vec3(1.0f) : _filters.factor(point, direction, distance, time);
    }
    /// The factor of the image around the scene in the radiance of a sample.
    vec3 image(const vec3& local) const {
        return _environment ? _environment->radiance(local) : vec3(1.0f);
    }
    /// Density with which sample() finds a position of an area light.
    float pdf(const vec3& point, const vec3& position, const vec3& normal, float time) const;
    bool intersect(const vec3& origin, const vec3& direction, float near, float far, float time,
                   float& distance, vec3& normal) const;
    /// Radiance of a position on an area light, towards `direction`.
    vec3 radiance(const vec3& position, const vec3& direction, float time) const;

    /// Where on a light at infinity a direction leads: the direction itself where there is no
    /// image.
    EnvironmentMap::Place place(const vec3& direction, float time) const;
    vec3 environment(const EnvironmentMap::Place& place, float time) const;
    float environmentPdf(const vec3& point, const vec3& normal, bool twoSided,
                         const EnvironmentMap::Place& place, float time) const;
    /// Estimate of the irradiance on a plane that faces the light; lights at infinity only.
    float irradiance() const { return _irradiance; }
    /// False when all of a light at infinity is behind a surface that does not transmit.
    bool reaches(const vec3& normal, bool twoSided) const;

    /// The light tree's view of this light; for lights that are not at infinity only.
    LightTreeLeaf leaf(int id) const;

private:
    using Pose = LightPose;

    Pose makePose(const mat4& toWorld) const;
    const Pose& poseAt(float time, Pose& scratch) const;
    bool setUpDome(LightImages& images);
    void addPortals(float time, Diagnostics& diagnostics);
    bool sampleBare(const EmitterDraw& draw, const vec3& point, const vec3& normal, bool twoSided,
                    float time, EmitterSample& out) const;
    bool sampleLine(const Pose& pose, const vec3& point, float u, EmitterSample& out) const;
    bool sampleDistant(const Pose& pose, const vec2& u, EmitterSample& out) const;
    bool sampleDome(const Pose& pose, const vec3& point, const vec3& normal, bool twoSided,
                    const EmitterDraw& draw, float time, EmitterSample& out) const;
    bool sampleSky(const Pose& pose, const vec3& normal, bool twoSided, const EmitterDraw& draw,
                   EmitterSample& out) const;
    float skyPdf(const Pose& pose, const vec3& normal, bool twoSided,
                 const EnvironmentMap::Place& place) const;
    vec3 texture(const AreaShape& shape, const vec3& position) const;
    vec3 shaped(const Pose& pose, const vec3& direction) const;

    // What every sample reads stands together: there may be more lights than caches hold.
    ResolvedLight _resolved; ///< at the shutter's opening
    bool _moves = false;
    Pose _pose; ///< at the shutter's opening
    std::shared_ptr<const ImageRGB> _texture;
    LightFilters _filters;
    // What some lights need, or the build alone.
    DomePortals _portals;
    std::shared_ptr<const EnvironmentMap> _environment;
    std::shared_ptr<const IesProfile> _profile;
    float _irradiance = 0.0f;
    float _meanTexture = 1.0f;
    std::shared_ptr<const Light> _light;
    mat4 _group{1.0f};
    dvec3 _origin{0.0};
    std::vector<float> _times; ///< at which the motion has corners, in the shutter
};

} // namespace patina
