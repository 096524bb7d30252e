// SPDX-License-Identifier: Apache-2.0
// From a light to its emitter, and the reasons why it gives no light.

#include "hdDelegate/lights/lightEmitter.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/diagnostics.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina {

namespace {

void readFiles(const Light& light, LightFiles& files, LightImages& images,
               Diagnostics& diagnostics) {
    if (files.read) return;
    files.read = true;
    files.profile = lightProfile(light, diagnostics);
    if (light.type != LightType::Rect || !light.hasImage()) return;
    files.texture = images.image(light);
    glm::dvec3 sum(0.0);
    for (const vec3& pixel : files.texture->pixels)
        sum += glm::dvec3(pixel);
    files.mean = vec3(sum / double(files.texture->pixels.size()));
}

} // namespace

LightEmitter::LightEmitter(std::shared_ptr<const Light> kept, const mat4& groupToWorld,
                           const dvec3& origin, float shutterOpen, float shutterClose,
                           LightFiles& files, LightImages& images, Diagnostics& diagnostics)
    : _light(std::move(kept)), _group(groupToWorld), _origin(origin) {
    const Light& light = *_light;
    if (!light.visible || light.type == LightType::Mesh) return;
    _times = {shutterOpen};
    if (light.transform.moves() && shutterClose > shutterOpen) {
        for (float time : light.transform.times)
            if (time > shutterOpen && time < shutterClose) _times.push_back(time);
        _times.push_back(shutterClose);
        _moves = true;
    }
    const auto toWorldAt = [&](float time) {
        return _group * transformAt(light.transform, time, origin);
    };
    _resolved = resolveLight(light, toWorldAt(shutterOpen), diagnostics);
    if (_resolved.kind == Kind::None) return;
    for (size_t i = 1; i < _times.size(); ++i)
        if (!isFinite(toWorldAt(_times[i]))) {
            diagnostics.warn(light.path, "xformOpOrder", messages::lightTransformNotFinite);
            _resolved.kind = Kind::None;
            return;
        }
    if (_resolved.kind == Kind::Distant) {
        Light like = light;
        like.angle = std::min(light.angle, 180.0f);
        const mat4 toWorld = toWorldAt(shutterOpen);
        _irradiance =
            _resolved.power() * float(_resolved.delta ? 1.0 : lightSizeFactor(like, toWorld));
    }
    readFiles(light, files, images, diagnostics);
    _profile = files.profile;
    _filters = LightFilters(light, groupToWorld, origin, shutterOpen, images, diagnostics);
    if (_resolved.kind == Kind::Dome && !setUpDome(images)) _resolved.kind = Kind::None;
    if (_resolved.kind == Kind::Area && files.texture) {
        _texture = files.texture;
        _meanTexture = luminance(files.mean * glm::abs(_resolved.radiance)) /
                       std::max(_resolved.power(), 1e-30f);
    }
    _pose = makePose(toWorldAt(shutterOpen));
    for (size_t i = 1; i < _times.size(); ++i)
        if (_resolved.kind == Kind::Area && !makePose(toWorldAt(_times[i])).shape.valid) {
            diagnostics.warn(light.path, lightSizeInput(light), messages::lightWithoutSize);
            _resolved.kind = Kind::None;
        }
    if (_resolved.kind == Kind::Dome) addPortals(shutterOpen, diagnostics);
    const bool anything = _resolved.power() * _meanTexture * _pose.shaping.level() > 0.0f;
    if (!anything) _resolved.kind = Kind::None;
}

bool LightEmitter::setUpDome(LightImages& images) {
    if (!_light->hasImage()) {
        _irradiance = pi * _resolved.power();
        return true;
    }
    _environment = images.environment(*_light);
    _irradiance = pi * luminance(glm::abs(_resolved.radiance) * _environment->mean());
    return !_environment->black();
}

/// Where they are when the shutter opens: they guide samples alone.
void LightEmitter::addPortals(float time, Diagnostics& diagnostics) {
    const mat3 toDome = glm::transpose(_pose.domeToWorld);
    for (const LightPortal& portal : _light->portals) {
        DomePortal made(_group * transformAt(portal.transform, time, _origin), portal.width,
                        portal.height, [&](const vec3& direction) {
                            return _environment
                                       ? luminance(_environment->radiance(toDome * direction))
                                       : 1.0f;
                        });
        if (made.valid())
            _portals.add(std::move(made));
        else
            diagnostics.warn(_light->path, "portals", messages::portalLeftOut(portal.path));
    }
}

LightEmitter::Pose LightEmitter::makePose(const mat4& toWorld) const {
    return lightPose(*_light, _resolved.kind, toWorld, _profile);
}

LightTreeLeaf LightEmitter::leaf(int id) const {
    LightTreeLeaf leaf;
    leaf.id = id;
    leaf.low = vec3(INFINITY);
    leaf.high = vec3(-INFINITY);
    leaf.hittable = _resolved.kind == Kind::Area;
    const bool round = _resolved.kind != Kind::Area || !lightRow(_light->type).flat;
    DirectionCone cone;
    for (size_t i = 0; i < _times.size(); ++i) {
        const Pose pose = makePose(_group * transformAt(_light->transform, _times[i], _origin));
        if (_resolved.kind == Kind::Area) {
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
        const float area = _resolved.kind != Kind::Area
                               ? (_resolved.kind == Kind::Line ? glm::length(pose.along) : 1.0f)
                           : round ? 0.25f * pose.shape.area
                                   : pose.shape.area;
        leaf.intensity = std::max(leaf.intensity,
                                  _resolved.power() * _meanTexture * area * pose.shaping.level());
    }
    leaf.axis = cone.axis;
    leaf.spread = cone.spread;
    leaf.reach = cone.reach;
    return leaf;
}

} // namespace patina
