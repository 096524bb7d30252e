#include "shaders/raster/vertices.glsl"
layout(location = 2) uniform mat4 worldToMap;

void main() {
    Instance instance = instances[drawVertices.z + gl_InstanceID];
    vec3 p = vector3At(cornerAt(gl_VertexID));
    gl_Position = worldToMap * (instance.objectToWorld * vec4(p, 1.0));
}
