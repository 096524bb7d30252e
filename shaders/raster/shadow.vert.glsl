// SPDX-License-Identifier: Apache-2.0
// Opaque casters: positions only.
#include "shaders/raster/instance.glsl"
layout(location = 2) uniform mat4 worldToMap;
layout(location = 6) uniform vec4 towardsLight; // position of the light, or direction where w is 0
layout(location = 3) uniform int category; // of what casts, -1: everything
#include "shaders/raster/links.glsl"
#ifdef AROUND_LIGHT
out vec3 vPosition;
#endif

void main() {
    vec3 p = positionFor(towardsLight);
#ifdef AROUND_LIGHT
    vPosition = p;
#endif
    gl_Position = worldToMap * vec4(p, 1.0);
    if (!isLinked(instanceIds.y, category)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // clipped
}
