// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightEmitter.h"

#include "hdDelegate/scene/lightUnits.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

const LightEmitter::Pose& LightEmitter::poseAt(float time, Pose& scratch) const {
    if (!_moves) return _pose;
    scratch = makePose(_group * transformAt(_light->transform, time, _origin));
    return scratch;
}

vec3 LightEmitter::texture(const AreaShape& shape, const vec3& position) const {
    if (!_texture) return vec3(1.0f);
    const shLights::TableCell c =
        shLights::rectTexels(shapeLocal(shape, position), _texture->width, _texture->height);
    const std::vector<vec3>& pixels = _texture->pixels;
    return tableMix(c, pixels[size_t(c.low)], pixels[size_t(c.lowNext)], pixels[size_t(c.high)],
                    pixels[size_t(c.highNext)]);
}

vec3 LightEmitter::shaped(const Pose& pose, const vec3& direction) const {
    return pose.shaping.active() ? _resolved.radiance * pose.shaping.factor(direction)
                                 : _resolved.radiance;
}

vec3 LightEmitter::radiance(const vec3& position, const vec3& direction, float time) const {
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    return shaped(pose, direction) * texture(pose.shape, position);
}

EmitterDraw LightEmitter::begin(const vec3& point, const vec3& normal, bool twoSided, const vec2& u,
                                float time) const {
    EmitterDraw draw;
    draw.u = u;
    if (!_portals.empty()) draw.guided = _portals.sample(point, draw.u, draw.direction);
    if (!_environment || draw.guided) return draw;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    draw.sky = _environment->begin(draw.u, normal * pose.domeToWorld, twoSided);
    return draw;
}

bool LightEmitter::sample(const EmitterDraw& draw, const vec3& point, const vec3& normal,
                          bool twoSided, float time, EmitterSample& out) const {
    if (!sampleBare(draw, point, normal, twoSided, time, out)) return false;
    if (!_filters.empty()) out.radiance *= filtered(point, out.direction, out.distance, time);
    return true;
}

bool LightEmitter::sampleBare(const EmitterDraw& draw, const vec3& point, const vec3& normal,
                              bool twoSided, float time, EmitterSample& out) const {
    const vec2& u = draw.u;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    switch (_resolved.kind) {
    case Kind::Area: {
        ShapeSample s;
        if (!sampleShape(pose.shape, point, u, s)) return false;
        const vec3 v = s.position - point;
        out.distance = glm::length(v);
        if (!(out.distance > 0.0f)) return false;
        out.direction = v / out.distance;
        out.normal = s.normal;
        out.pdf = s.pdf;
        out.radiance = shaped(pose, -out.direction) * texture(pose.shape, s.position);
        return true;
    }
    case Kind::Point: {
        const vec3 v = pose.position - point;
        const float d2 = glm::dot(v, v);
        if (!(d2 > 0.0f)) return false;
        out.distance = std::sqrt(d2);
        out.direction = v / out.distance;
        out.normal = -out.direction;
        out.pdf = 1.0f;
        out.radiance = shaped(pose, -out.direction) / d2;
        return std::isfinite(out.radiance.x + out.radiance.y + out.radiance.z);
    }
    case Kind::Line: return sampleLine(pose, point, u.x, out);
    case Kind::Distant: return sampleDistant(pose, u, out);
    case Kind::Dome: return sampleDome(pose, point, normal, twoSided, draw, time, out);
    default: return false;
    }
}

bool LightEmitter::sampleLine(const Pose& pose, const vec3& point, float u,
                              EmitterSample& out) const {
    vec3 d;
    float pdf;
    if (!shLights::lineSample(pose.position, pose.along, point, u, d, pdf)) return false;
    const float d2 = glm::dot(d, d);
    out.distance = std::sqrt(d2);
    out.direction = d / out.distance;
    out.normal = -out.direction;
    // A density along the line is divided out here, so that the selection alone remains.
    const float across = shLights::lineAcross(pose.along / glm::length(pose.along), out.direction);
    out.pdf = 1.0f;
    out.radiance = shaped(pose, -out.direction) * (across / (d2 * pdf));
    return std::isfinite(out.radiance.x + out.radiance.y + out.radiance.z);
}

bool LightEmitter::sampleDistant(const Pose& pose, const vec2& u, EmitterSample& out) const {
    out.distance = INFINITY;
    out.normal = vec3(0.0f);
    out.radiance = _resolved.radiance;
    if (_resolved.delta) {
        out.direction = pose.toLight;
        out.pdf = 1.0f;
        return true;
    }
    out.direction =
        shLights::distantSample(shLights::lightBasis(pose.toLight), _resolved.versine, u);
    out.pdf = shLights::distantPdf(_resolved.versine);
    return true;
}

bool LightEmitter::sampleDome(const Pose& pose, const vec3& point, const vec3& normal,
                              bool twoSided, const EmitterDraw& draw, float time,
                              EmitterSample& out) const {
    if (_portals.empty()) return sampleSky(pose, normal, twoSided, draw, out);
    if (draw.guided) {
        out.distance = INFINITY;
        out.normal = vec3(0.0f);
        out.radiance = _resolved.radiance;
        out.direction = draw.direction;
        out.local = glm::transpose(pose.domeToWorld) * out.direction;
        out.pdf = skyPdf(pose, normal, twoSided, place(out.direction, time));
    } else if (!sampleSky(pose, normal, twoSided, draw, out)) {
        return false;
    }
    out.pdf = _portals.pdf(point, out.direction, out.pdf);
    return out.pdf > 0.0f && std::isfinite(out.pdf);
}

bool LightEmitter::sampleSky(const Pose& pose, const vec3& normal, bool twoSided,
                             const EmitterDraw& draw, EmitterSample& out) const {
    out.distance = INFINITY;
    out.normal = vec3(0.0f);
    out.radiance = _resolved.radiance;
    if (_environment) {
        out.local = _environment->sample(draw.sky, out.pdf);
        out.direction = pose.domeToWorld * out.local;
        return out.pdf > 0.0f && std::isfinite(out.pdf);
    }
    const vec2& u = draw.u;
    const float phi = 2.0f * pi * u.y;
    if (normal == vec3(0.0f)) {
        const float z = 1.0f - 2.0f * u.x, s = std::sqrt(std::max(0.0f, 1.0f - z * z));
        out.direction = vec3(s * std::cos(phi), s * std::sin(phi), z);
        out.pdf = 0.25f / pi;
        return true;
    }
    float r = u.x, side = 1.0f;
    if (twoSided) {
        side = r < 0.5f ? 1.0f : -1.0f;
        r = r < 0.5f ? 2.0f * r : 2.0f * r - 1.0f;
    }
    const float cosine = std::sqrt(1.0f - r), sine = std::sqrt(r);
    vec3 x, y;
    orthonormalBasis(normal, x, y);
    out.direction =
        glm::normalize(side * cosine * normal + sine * (std::cos(phi) * x + std::sin(phi) * y));
    out.pdf = cosine / (twoSided ? 2.0f * pi : pi);
    return out.pdf > 0.0f;
}

float LightEmitter::pdf(const vec3& point, const vec3& position, const vec3& normal,
                        float time) const {
    if (_resolved.kind != Kind::Area) return 0.0f;
    Pose scratch;
    const float pdf = shapePdf(poseAt(time, scratch).shape, point, position, normal);
    return std::isfinite(pdf) ? pdf : 0.0f;
}

bool LightEmitter::intersect(const vec3& origin, const vec3& direction, float near, float far,
                             float time, float& distance, vec3& normal) const {
    if (_resolved.kind != Kind::Area) return false;
    Pose scratch;
    return intersectShape(poseAt(time, scratch).shape, origin, direction, near, far, distance,
                          normal);
}

EnvironmentMap::Place LightEmitter::place(const vec3& direction, float time) const {
    if (!_environment) return {direction};
    Pose scratch;
    return _environment->place(glm::transpose(poseAt(time, scratch).domeToWorld) * direction);
}

vec3 LightEmitter::environment(const EnvironmentMap::Place& place, float time) const {
    if (_resolved.delta || !atInfinity()) return vec3(0.0f);
    if (_environment) return _resolved.radiance * _environment->radiance(place);
    if (_resolved.kind != Kind::Distant) return _resolved.radiance;
    Pose scratch;
    return shLights::distantHit(poseAt(time, scratch).toLight, _resolved.versine, place.direction)
               ? _resolved.radiance
               : vec3(0.0f);
}

float LightEmitter::environmentPdf(const vec3& point, const vec3& normal, bool twoSided,
                                   const EnvironmentMap::Place& place, float time) const {
    if (_resolved.delta || !atInfinity()) return 0.0f;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    if (_resolved.kind == Kind::Distant)
        return shLights::distantHit(pose.toLight, _resolved.versine, place.direction)
                   ? shLights::distantPdf(_resolved.versine)
                   : 0.0f;
    const float own = skyPdf(pose, normal, twoSided, place);
    if (_portals.empty()) return own;
    // Of an image the place is in its own frame.
    const vec3 world = _environment ? pose.domeToWorld * place.direction : place.direction;
    return _portals.pdf(point, world, own);
}

float LightEmitter::skyPdf(const Pose& pose, const vec3& normal, bool twoSided,
                           const EnvironmentMap::Place& place) const {
    if (_environment) return _environment->pdf(place, normal * pose.domeToWorld, twoSided);
    if (normal == vec3(0.0f)) return 0.25f / pi;
    const float cosine = glm::dot(normal, place.direction);
    return twoSided ? std::abs(cosine) / (2.0f * pi) : std::max(0.0f, cosine) / pi;
}

bool LightEmitter::reaches(const vec3& normal, bool twoSided) const {
    if (_resolved.kind != Kind::Distant || _moves || twoSided || normal == vec3(0.0f)) return true;
    return glm::dot(_pose.toLight, normal) >
           -std::sin(std::min(_resolved.halfAngle, 0.5f * pi)) - 1e-4f;
}

} // namespace patina
