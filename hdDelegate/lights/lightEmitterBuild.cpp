// What a light becomes, and the reasons why it gives no light.

#include "hdDelegate/lights/areaShapeParts.h"
#include "hdDelegate/lights/lightEmitter.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/diagnostics.h"
#include "materialNetwork/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool isFinite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool isFinite(const mat4& m) {
    for (int i = 0; i < 4; ++i)
        if (!isFinite(vec3(m[i]))) return false;
    return true;
}

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

} // namespace

LightEmitter::LightEmitter(const Light& light, const mat4& groupToWorld, const dvec3& origin,
                           float shutterOpen, float shutterClose, LightImages& images,
                           Diagnostics& diagnostics)
    : _light(light), _group(groupToWorld), _origin(origin) {
    if (!light.visible || light.type == LightType::Mesh) return;
    const auto warn = [&](const std::string& input, const char* message) {
        diagnostics.warn(light.path, input, message);
    };
    _times = {shutterOpen};
    if (light.transform.moves() && shutterClose > shutterOpen) {
        for (float time : light.transform.times)
            if (time > shutterOpen && time < shutterClose) _times.push_back(time);
        _times.push_back(shutterClose);
        _moves = true;
    }
    for (float time : _times)
        if (!isFinite(_group * transformAt(light.transform, time, origin))) {
            warn("xformOpOrder", "the transform is not finite; the light is off");
            return;
        }
    const mat4 toWorld = _group * transformAt(light.transform, shutterOpen, origin);
    if (!isFinite(lightBaseRadiance(light))) {
        warn("inputs:intensity", "the light's colour or intensity is not finite; the light is off");
        return;
    }
    if (lightBaseRadiance(light) == vec3(0.0f)) return;
    if (!choosesKind(toWorld, diagnostics)) {
        _kind = Kind::None;
        return;
    }
    const vec3 signedRadiance = _radiance;
    _radiance = glm::max(_radiance, vec3(0.0f));
    if (_radiance != signedRadiance)
        warn("inputs:intensity", "negative light is not supported and counts as zero");
    loadProfile(diagnostics);
    const bool usesTexture = !light.textureFile.empty();
    if (_kind == Kind::Dome && !setUpDome(images)) _kind = Kind::None;
    if (_kind == Kind::Area && light.type == LightType::Rect && usesTexture) {
        _texture = images.image(light.textureFile, light.textureColorSpace, light.path,
                                "inputs:texture:file");
        glm::dvec3 sum(0.0);
        for (const vec3& pixel : _texture->pixels)
            sum += glm::dvec3(pixel);
        const vec3 mean(sum / double(_texture->pixels.size()));
        _meanTexture = luminance(mean * _radiance) / std::max(luminance(_radiance), 1e-30f);
    }
    _pose = makePose(toWorld);
    for (float time : _times)
        if (_kind == Kind::Area &&
            !makePose(_group * transformAt(light.transform, time, origin)).shape.valid) {
            warn(lightSizeInput(_light),
                 "the light has no size or is flattened to nothing; it is off");
            _kind = Kind::None;
        }
    const bool anything = luminance(_radiance) * _meanTexture * _pose.shaping.level() > 0.0f;
    if (!anything || !isFinite(_radiance)) _kind = Kind::None;
}

/// Decides what the light is treated as, and how bright that is.
/// @returns false when there is nothing to render
bool LightEmitter::choosesKind(const mat4& toWorld, Diagnostics& diagnostics) {
    const auto off = [&](const std::string& input, const char* message) {
        diagnostics.warn(_light.path, input, message);
        return false;
    };
    const double size = lightSizeFactor(_light, toWorld);
    const vec3 base = lightBaseRadiance(_light);
    _radiance = _light.normalize ? vec3(glm::dvec3(base) / size) : base;
    switch (_light.type) {
    case LightType::Distant: {
        _kind = Kind::Distant;
        if (!std::isfinite(_light.angle))
            return off("inputs:angle", "the angle is not finite; the light is off");
        _halfAngle = 0.5f * std::clamp(_light.angle, 0.0f, 360.0f) * (pi / 180.0f);
        // 1 - cos without cancellation.
        const float s = std::sin(0.5f * _halfAngle);
        _oneMinusCos = 2.0f * s * s;
        _delta = !(_oneMinusCos > 0.0f);
        Light like = _light;
        like.angle = std::min(_light.angle, 180.0f);
        _irradiance = luminance(_radiance) * float(_delta ? 1.0 : lightSizeFactor(like, toWorld));
        return true;
    }
    case LightType::Dome: _kind = Kind::Dome; return true;
    case LightType::Sphere:
    case LightType::Cylinder: {
        const bool sphere = _light.type == LightType::Sphere;
        const double length = glm::length(glm::dvec3(vec3(toWorld[0]))) * std::abs(_light.length);
        if (!std::isfinite(size) || (!sphere && !(length > 0.0)))
            return off(sphere ? "inputs:radius" : "inputs:length",
                       "the light's size is zero or not finite; the light is off");
        const bool hint = sphere ? _light.treatAsPoint : _light.treatAsLine;
        if (hint || (size == 0.0 && _light.normalize)) {
            // The mean projected area of a convex body is a quarter of its surface (Cauchy); a thin
            // line's projected width is its surface / (pi length).
            const double projected = sphere ? 0.25 : 1.0 / (piDouble * length);
            _radiance = vec3(glm::dvec3(base) * projected * (_light.normalize ? 1.0 : size));
            _kind = sphere ? Kind::Point : Kind::Line;
            _delta = true;
            return true;
        }
        break;
    }
    default: break;
    }
    _kind = Kind::Area;
    if (!(size > 0.0) || !std::isfinite(size))
        return off(lightSizeInput(_light),
                   "the light's size is zero or not finite; the light is off");
    return true;
}

void LightEmitter::loadProfile(Diagnostics& diagnostics) {
    if (_light.iesFile.empty() || atInfinity()) return;
    auto profile = std::make_shared<IesProfile>();
    std::string error;
    if (profile->load(_light.iesFile, error))
        _profile = profile;
    else
        diagnostics.warn(_light.path, "inputs:shaping:ies:file",
                         "'" + _light.iesFile + "' " + error + "; the light is not shaped by it");
}

bool LightEmitter::setUpDome(LightImages& images) {
    if (_light.textureFile.empty()) {
        _irradiance = pi * luminance(_radiance);
        return true;
    }
    _environment = images.environment(_light.textureFile, _light.textureColorSpace,
                                      environmentFormat(_light.textureFormat), _light.path,
                                      "inputs:texture:file");
    _irradiance = pi * luminance(_radiance * _environment->mean());
    return !_environment->black();
}

LightEmitter::Pose LightEmitter::makePose(const mat4& toWorld) const {
    Pose pose;
    pose.position = vec3(toWorld[3]);
    switch (_kind) {
    case Kind::Area: pose.shape = makeAreaShape(_light, toWorld); break;
    case Kind::Line: pose.along = vec3(toWorld[0]) * _light.length; break;
    case Kind::Distant: {
        const vec3 z = vec3(toWorld[2]);
        const float length = glm::length(z);
        pose.toLight = length > 0.0f ? z / length : vec3(0.0f, 0.0f, 1.0f);
        return pose;
    }
    case Kind::Dome: rotationOf(toWorld, pose.domeToWorld); return pose;
    default: break;
    }
    pose.shaping = LightShaping(_light, toWorld, _profile);
    return pose;
}

LightTreeLeaf LightEmitter::leaf(int id) const {
    LightTreeLeaf leaf;
    leaf.id = id;
    leaf.low = vec3(INFINITY);
    leaf.high = vec3(-INFINITY);
    leaf.hittable = _kind == Kind::Area;
    const bool round = _kind != Kind::Area || _light.type == LightType::Sphere ||
                       _light.type == LightType::Cylinder;
    DirectionCone cone;
    for (size_t i = 0; i < _times.size(); ++i) {
        const Pose pose = makePose(_group * transformAt(_light.transform, _times[i], _origin));
        if (_kind == Kind::Area) {
            growBounds(pose.shape, leaf.low, leaf.high);
        } else {
            const vec3 extent = 0.5f * glm::abs(pose.along);
            leaf.low = glm::min(leaf.low, pose.position - extent);
            leaf.high = glm::max(leaf.high, pose.position + extent);
        }
        // A round light shines everywhere, unless a cone keeps it together.
        DirectionCone here{pose.shaping.axis(), pi, 0.5f * pi};
        const float cutoff = pose.shaping.cutoff();
        if (!round)
            here = {pose.shape.normal, 0.0f, std::min(0.5f * pi, cutoff)};
        else if (cutoff < pi)
            here = {pose.shaping.axis(), cutoff, 0.0f};
        cone = i == 0 ? here : unite(cone, here);
        const float area = _kind != Kind::Area
                               ? (_kind == Kind::Line ? glm::length(pose.along) : 1.0f)
                           : round ? 0.25f * pose.shape.area
                                   : pose.shape.area;
        leaf.intensity = std::max(leaf.intensity, luminance(_radiance) * _meanTexture * area *
                                                      pose.shaping.level());
    }
    leaf.axis = cone.axis;
    leaf.spread = cone.spread;
    leaf.reach = cone.reach;
    return leaf;
}

} // namespace patina
