// SPDX-License-Identifier: Apache-2.0
// Casters that light may pass: presence as a chance, as seen from the light.
layout(location = 6) uniform vec4 towardsLight; // position of the light, or direction where w is 0
#include "shaders/raster/lightShape.glsl"

#include "shaders/raster/slope.glsl"

void main() {
    writeSlope();
    if (isOfLight(vPosition)) discard;
    setPoint(towardsLight.w != 0.0 ? normalize(towardsLight.xyz - vPosition) : towardsLight.xyz, 0.0);
#ifdef PRESENCE
    if (!isPresent()) discard;
#endif
#ifdef MATERIAL_PASSES
    // Refracted light goes straight on here, with the luminance of its share as a chance. It leaves as
    // it enters: straight ways out would be reflected where those that refraction turned are not.
    if (!woOutside()) setPoint(-point.view, 0.0);
    materialSetup();
    if (ownRandom(32u) < luminance(materialPasses())) discard;
#endif
}
