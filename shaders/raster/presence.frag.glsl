// Casters that light may pass: presence as a chance, as seen from the light.
layout(location = 6) uniform vec4 towardsLight; // position of the light, or direction where w is 0
#include "shaders/raster/lightShape.glsl"

void main() {
    if (isInsideLight(vPosition)) discard;
    setPoint(towardsLight.w != 0.0 ? normalize(towardsLight.xyz - vPosition) : towardsLight.xyz, 0.0);
    if (!isPresent()) discard;
}
