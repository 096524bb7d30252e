// Opaque casters: positions only.
#include "shaders/raster/instance.glsl"
layout(location = 2) uniform mat4 worldToMap;

void main() {
    gl_Position = worldToMap * vec4(worldPosition(), 1.0);
}
