// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/resolvedLight.h"

#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"
#include "base/diagnostics.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

using Kind = ResolvedLight::Kind;

/// The rotation (or reflection) nearest to a transform in the order z, y, x; its scale is dropped.
bool rotationOf(const mat4& m, mat3& out) {
    vec3 z = vec3(m[2]), y = vec3(m[1]), x = vec3(m[0]);
    const float lz = glm::length(z);
    if (!(lz > 0.0f)) return false;
    z /= lz;
    y -= glm::dot(y, z) * z;
    const float ly = glm::length(y);
    if (!(ly > 0.0f)) return false;
    y /= ly;
    vec3 across = glm::cross(y, z);
    if (glm::dot(across, x) < 0.0f) across = -across;
    out = mat3(across, y, z);
    return true;
}

/// The shape that stands for the light, and its brightness, before its colour's sign is looked at.
ResolvedLight kindOf(const Light& light, const mat4& toWorld, Diagnostics& diagnostics) {
    ResolvedLight r;
    const auto off = [&](const std::string& input, const Message& why) {
        diagnostics.warn(light.path, input, why);
        return ResolvedLight();
    };
    const double size = lightSizeFactor(light, toWorld);
    const vec3 base = lightBaseRadiance(light);
    r.radiance = light.normalize ? vec3(glm::dvec3(base) / size) : base;
    switch (light.type) {
    case LightType::Distant: {
        r.kind = Kind::Distant;
        if (!std::isfinite(light.angle)) return off("inputs:angle", messages::lightAngleNotFinite);
        r.halfAngle = 0.5f * std::clamp(light.angle, 0.0f, 360.0f) * (pi / 180.0f);
        const float s = std::sin(0.5f * r.halfAngle);
        r.versine = 2.0f * s * s;
        r.delta = !(r.versine > 0.0f);
        return r;
    }
    case LightType::Dome: r.kind = Kind::Dome; return r;
    case LightType::Sphere:
    case LightType::Cylinder: {
        const bool sphere = light.type == LightType::Sphere;
        const double length = glm::length(glm::dvec3(vec3(toWorld[0]))) * std::abs(light.length);
        if (!std::isfinite(size) || (!sphere && !(length > 0.0)))
            return off(sphere ? "inputs:radius" : "inputs:length", messages::lightSizeUnusable);
        const bool hint = sphere ? light.treatAsPoint : light.treatAsLine;
        if (size > 0.0 ? hint : light.normalize && size == 0.0) {
            // The mean projected area of a convex body is a quarter of its surface (Cauchy); a thin
            // line's projected width is its surface / (pi length).
            const double projected = sphere ? 0.25 : 1.0 / (piDouble * length);
            r.radiance = vec3(glm::dvec3(base) * projected * (light.normalize ? 1.0 : size));
            r.kind = sphere ? Kind::Point : Kind::Line;
            r.delta = true;
            return r;
        }
        break;
    }
    default: break;
    }
    r.kind = Kind::Area;
    if (!(size > 0.0) || !std::isfinite(size))
        return off(lightSizeInput(light), messages::lightSizeUnusable);
    return r;
}

} // namespace

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const mat4& m) {
    for (int i = 0; i < 4; ++i)
        if (!isFinite(vec3(m[i]))) return false;
    return true;
}

ResolvedLight resolveLight(const Light& light, const mat4& toWorld, Diagnostics& diagnostics) {
    if (!light.visible || light.type == LightType::Mesh) return {};
    if (!isFinite(toWorld)) {
        diagnostics.warn(light.path, "xformOpOrder", messages::lightTransformNotFinite);
        return {};
    }
    const vec3 base = lightBaseRadiance(light);
    if (!isFinite(base)) {
        diagnostics.warn(light.path, "inputs:intensity", messages::lightNotFinite);
        return {};
    }
    if (base == vec3(0.0f)) return {};
    ResolvedLight r = kindOf(light, toWorld, diagnostics);
    if (r.kind == Kind::None) return r;
    if (r.kind == Kind::Area && !makeAreaShape(light, toWorld).valid) {
        diagnostics.warn(light.path, lightSizeInput(light), messages::lightWithoutSize);
        return {};
    }
    if (r.radiance == vec3(0.0f) || !isFinite(r.radiance)) return {};
    return r;
}

float ResolvedLight::power() const {
    return luminance(glm::abs(radiance));
}

namespace {

/// Whether a factor of the filter may be below 0.
bool canTurnSign(const LightFilter& filter) {
    const auto negative = [](float value) { return value < 0.0f; };
    return filter.intensity < 0.0f ||
           std::any_of(filter.rampFloats.begin(), filter.rampFloats.end(), negative) ||
           std::any_of(filter.colors.begin(), filter.colors.end(),
                       [&](const vec3& color) {
                           return negative(std::min({color.x, color.y, color.z}));
                       }) ||
           // Overshoot of the curve, and images above 1 that are inverted.
           filter.rampInterpolation.rfind("catmull", 0) == 0 ||
           filter.colorInterpolation.rfind("catmull", 0) == 0 || filter.invert;
}

} // namespace

bool takesLightAway(const SceneState& state, const RenderSettings& settings) {
    if (!settings.enableSceneLights) return false;
    for (const auto& item : state.lights) {
        const vec3 base = lightBaseRadiance(*item.second);
        if (!item.second->visible) continue;
        if (std::min({base.x, base.y, base.z}) < 0.0f) return true;
        const auto& filters = item.second->filters;
        if (std::any_of(filters.begin(), filters.end(), canTurnSign)) return true;
    }
    return false;
}

LightPose lightPose(const Light& light, Kind kind, const mat4& toWorld,
                    std::shared_ptr<const IesProfile> profile) {
    LightPose pose;
    pose.position = vec3(toWorld[3]);
    switch (kind) {
    case Kind::Area: pose.shape = makeAreaShape(light, toWorld); break;
    case Kind::Line: pose.along = vec3(toWorld[0]) * light.length; break;
    case Kind::Distant: {
        const vec3 z = vec3(toWorld[2]);
        const float length = glm::length(z);
        pose.toLight = length > 0.0f ? z / length : vec3(0.0f, 0.0f, 1.0f);
        return pose;
    }
    case Kind::Dome: rotationOf(toWorld, pose.domeToWorld); return pose;
    default: break;
    }
    pose.shaping = LightShaping(light, toWorld, std::move(profile));
    return pose;
}

std::shared_ptr<const IesProfile> lightProfile(const Light& light, Diagnostics& diagnostics) {
    const bool atInfinity = light.type == LightType::Distant || light.type == LightType::Dome;
    if (light.iesFile.empty() || atInfinity) return nullptr;
    auto profile = std::make_shared<IesProfile>();
    std::string error;
    if (profile->load(light.iesFile, error)) return profile;
    diagnostics.warn(light.path, "inputs:shaping:ies:file",
                     messages::profileUnreadable(light.iesFile, error));
    return nullptr;
}

ProfileGrid profileGrid(const Light& light, const IesProfile& profile, int thetas, int phis) {
    const float mean = profile.mean();
    const float scale = !light.iesNormalize ? 1.0f : mean > 0.0f ? 1.0f / mean : 0.0f;
    ProfileGrid grid;
    grid.thetas = thetas;
    grid.phis = phis;
    bool round = true;
    for (int p = 0; p < phis; ++p)
        for (int t = 0; t < thetas; ++t) {
            const float theta =
                IesProfile::scaledTheta(float(t) / float(thetas - 1) * pi, light.iesAngleScale);
            const float phi = float(p) / float(phis - 1) * 2.0f * pi;
            grid.values.push_back(profile.candela(theta, phi) * scale);
            const float first = grid.values[size_t(t)];
            round &= std::fabs(grid.values.back() - first) <= 1e-4f * std::fabs(first);
        }
    if (round) {
        grid.phis = 1;
        grid.values.resize(size_t(thetas));
    }
    return grid;
}

} // namespace patina
