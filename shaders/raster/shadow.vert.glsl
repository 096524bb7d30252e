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

void main() {
    int i = 3 * gl_VertexID;
    vec4 p = vec4(positions[i], positions[i + 1], positions[i + 2], 1.0);
    gl_Position = worldToMap * (instances[firstInstance + gl_InstanceID].objectToWorld * p);
}
