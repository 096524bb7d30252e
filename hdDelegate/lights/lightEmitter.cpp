#include "hdDelegate/lights/lightEmitter.h"

#include "hdDelegate/lights/areaShapeParts.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

const LightEmitter::Pose& LightEmitter::poseAt(float time, Pose& scratch) const {
    if (!_moves) return _pose;
    scratch = makePose(_group * transformAt(_light.transform, time, _origin));
    return scratch;
}

/// Rect texture: the image's left top corner is at (+x, +y), as the schema puts it.
vec3 LightEmitter::texture(const AreaShape& shape, const vec3& position) const {
    if (!_texture) return vec3(1.0f);
    const vec3 q = shape.local(position);
    const int w = _texture->width, h = _texture->height;
    const float x = (0.5f - q.x) * float(w) - 0.5f, y = (0.5f - q.y) * float(h) - 0.5f;
    const float fx = std::clamp(x, 0.0f, float(w - 1)), fy = std::clamp(y, 0.0f, float(h - 1));
    const int x0 = int(fx), y0 = int(fy), x1 = std::min(x0 + 1, w - 1),
              y1 = std::min(y0 + 1, h - 1);
    const float tx = fx - float(x0), ty = fy - float(y0);
    const auto at = [&](int i, int k) {
        return _texture->pixels[size_t(k) * size_t(w) + size_t(i)];
    };
    return (1.0f - ty) * ((1.0f - tx) * at(x0, y0) + tx * at(x1, y0)) +
           ty * ((1.0f - tx) * at(x0, y1) + tx * at(x1, y1));
}

vec3 LightEmitter::shaped(const Pose& pose, const vec3& direction) const {
    return pose.shaping.active() ? _radiance * pose.shaping.factor(direction) : _radiance;
}

vec3 LightEmitter::radiance(const vec3& position, const vec3& direction, float time) const {
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    return shaped(pose, direction) * texture(pose.shape, position);
}

EmitterDraw LightEmitter::begin(const vec3& normal, bool twoSided, const vec2& u,
                                float time) const {
    EmitterDraw draw;
    draw.u = u;
    if (!_environment) return draw;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    draw.sky = _environment->begin(u, normal * pose.domeToWorld, twoSided);
    return draw;
}

bool LightEmitter::sample(const EmitterDraw& draw, const vec3& point, const vec3& normal,
                          bool twoSided, float time, EmitterSample& out) const {
    const vec2& u = draw.u;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    switch (_kind) {
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
    case Kind::Dome: return sampleDome(pose, normal, twoSided, draw, out);
    default: return false;
    }
}

/// Equiangular along the line (Kulla and Fajardo 2012).
bool LightEmitter::sampleLine(const Pose& pose, const vec3& point, float u,
                              EmitterSample& out) const {
    const float length = glm::length(pose.along);
    if (!(length > 0.0f)) return false;
    const vec3 axis = pose.along / length;
    const vec3 v = point - pose.position;
    const float middle = glm::dot(v, axis);
    const float away = std::max(glm::length(v - middle * axis), 1e-4f * length);
    const float a = (-0.5f * length - middle) / away, b = (0.5f * length - middle) / away;
    const float angle = std::atan2(b - a, 1.0f + a * b);
    const float turn = std::tan(u * angle), x = (a + turn) / (1.0f - a * turn);
    const vec3 d = pose.position + (middle + x * away) * axis - point;
    const float d2 = glm::dot(d, d);
    if (!(d2 > 0.0f) || !(angle > 0.0f)) return false;
    out.distance = std::sqrt(d2);
    out.direction = d / out.distance;
    out.normal = -out.direction;
    // A density along the line is divided out here, so that the selection alone remains.
    const float pdf = 1.0f / ((1.0f + x * x) * angle * away);
    const float cosine = glm::dot(out.direction, axis);
    const float across = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    out.pdf = 1.0f;
    out.radiance = shaped(pose, -out.direction) * (across / (d2 * pdf));
    return std::isfinite(out.radiance.x + out.radiance.y + out.radiance.z);
}

bool LightEmitter::sampleDistant(const Pose& pose, const vec2& u, EmitterSample& out) const {
    out.distance = INFINITY;
    out.normal = vec3(0.0f);
    out.radiance = _radiance;
    if (_delta) {
        out.direction = pose.toLight;
        out.pdf = 1.0f;
        return true;
    }
    const float h = u.x * _oneMinusCos;
    const float sine = std::sqrt(std::max(0.0f, h * (2.0f - h))), phi = 2.0f * pi * u.y;
    vec3 x, y;
    orthonormalBasis(pose.toLight, x, y);
    out.direction =
        glm::normalize((1.0f - h) * pose.toLight + sine * (std::cos(phi) * x + std::sin(phi) * y));
    out.pdf = 1.0f / (2.0f * pi * _oneMinusCos);
    return true;
}

bool LightEmitter::sampleDome(const Pose& pose, const vec3& normal, bool twoSided,
                              const EmitterDraw& draw, EmitterSample& out) const {
    out.distance = INFINITY;
    out.normal = vec3(0.0f);
    out.radiance = _radiance;
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
    if (_kind != Kind::Area) return 0.0f;
    Pose scratch;
    const float pdf = shapePdf(poseAt(time, scratch).shape, point, position, normal);
    return std::isfinite(pdf) ? pdf : 0.0f;
}

bool LightEmitter::intersect(const vec3& origin, const vec3& direction, float near, float far,
                             float time, float& distance, vec3& normal) const {
    if (_kind != Kind::Area) return false;
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
    if (_delta || !atInfinity()) return vec3(0.0f);
    if (_environment) return _radiance * _environment->radiance(place);
    if (_kind != Kind::Distant) return _radiance;
    // |direction - axis|^2 = 2 (1 - cos), which keeps small angles precise.
    Pose scratch;
    const vec3 d = place.direction - poseAt(time, scratch).toLight;
    return 0.5f * glm::dot(d, d) <= _oneMinusCos ? _radiance : vec3(0.0f);
}

float LightEmitter::environmentPdf(const vec3& normal, bool twoSided,
                                   const EnvironmentMap::Place& place, float time) const {
    if (_delta || !atInfinity()) return 0.0f;
    Pose scratch;
    const Pose& pose = poseAt(time, scratch);
    if (_kind == Kind::Distant) {
        const vec3 d = place.direction - pose.toLight;
        return 0.5f * glm::dot(d, d) <= _oneMinusCos ? 1.0f / (2.0f * pi * _oneMinusCos) : 0.0f;
    }
    if (_environment) return _environment->pdf(place, normal * pose.domeToWorld, twoSided);
    if (normal == vec3(0.0f)) return 0.25f / pi;
    const float cosine = glm::dot(normal, place.direction);
    return twoSided ? std::abs(cosine) / (2.0f * pi) : std::max(0.0f, cosine) / pi;
}

bool LightEmitter::reaches(const vec3& normal, bool twoSided) const {
    if (_kind != Kind::Distant || _moves || twoSided || normal == vec3(0.0f)) return true;
    return glm::dot(_pose.toLight, normal) > -std::sin(std::min(_halfAngle, 0.5f * pi)) - 1e-4f;
}

} // namespace patina
