// Opaque casters: positions only, indexed.
struct Instance {
    mat4 objectToWorld;
    mat4 normalToWorld;
    ivec4 ids;
};
layout(std430, binding = 3) readonly buffer Instances { Instance instances[]; };
layout(std430, binding = 6) readonly buffer Positions { float positions[]; };
layout(location = 0) uniform int firstInstance;
layout(location = 2) uniform mat4 worldToMap;
layout(location = 3) uniform int category; // of what casts, -1: everything
#include "shaders/raster/links.glsl"

void main() {
    int i = 3 * gl_VertexID;
    vec4 p = vec4(positions[i], positions[i + 1], positions[i + 2], 1.0);
    Instance instance = instances[firstInstance + gl_InstanceID];
    gl_Position = worldToMap * (instance.objectToWorld * p);
    if (!isLinked(instance.ids.y, category)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // clipped
}
