// SPDX-License-Identifier: Apache-2.0
#include "shaders/raster/slope.glsl"
#ifdef AROUND_LIGHT
#include "shaders/raster/lightShape.glsl"
in vec3 vPosition;
#endif

void main() {
    writeSlope();
#ifdef AROUND_LIGHT
    if (isOfLight(vPosition)) discard;
#endif
}
