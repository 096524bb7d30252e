// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightFields.h"

namespace patina {

void LightFields::setLight(const Light& light, const ResolvedLight& resolved,
                           const LightPose& pose) {
    diffuse = light.diffuse;
    specular = light.specular;
    set(shLights::LIGHT_IS_DELTA, resolved.delta);
    setShaping(pose.shaping);
    switch (resolved.kind) {
    case ResolvedLight::Kind::None: return;
    case ResolvedLight::Kind::Distant:
        kind = shLights::LIGHT_DISTANT;
        axis2 = pose.toLight;
        versine = resolved.versine;
        return;
    case ResolvedLight::Kind::Dome:
        kind = shLights::LIGHT_DOME;
        setAxes(pose.domeToWorld);
        return;
    case ResolvedLight::Kind::Point:
        kind = shLights::LIGHT_POINT;
        origin = pose.position;
        break;
    case ResolvedLight::Kind::Line: {
        const float length = glm::length(pose.along);
        kind = shLights::LIGHT_LINE;
        origin = pose.position;
        axis0 = pose.along / length;
        density = 1.0f / length;
        break;
    }
    case ResolvedLight::Kind::Area:
        kind = int(pose.shape.kind);
        origin = pose.shape.origin;
        setAxes(pose.shape.axes);
        setInverse(pose.shape.inverse);
        break;
    }
    set(shLights::LIGHT_AT_PLACE);
}

void LightFields::setShaping(const LightShaping& shaping) {
    const shLights::Shaping& beam = shaping.beam();
    shapingAxis = beam.axis;
    shapingX = beam.x;
    shapingY = beam.y;
    focus = beam.focus;
    focusTint = beam.focusTint;
    set(shLights::LIGHT_HAS_CONE, beam.cone);
    coneStart = beam.coneStart;
    coneEnd = beam.coneEnd;
}

} // namespace patina
