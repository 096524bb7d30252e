#include "shaders/raster/passBlock.glsl"
#include "shaders/raster/vertices.glsl"

#ifdef SHADOW
layout(location = 2) uniform mat4 worldToMap;
layout(location = 3) uniform int category; // of what casts, -1: everything
#include "shaders/raster/links.glsl"
#endif

out vec3 vPosition;
out vec3 vObjectPosition;
out vec3 vNormal;
flat out vec3 vTangent;
flat out vec3 vBitangent;
flat out vec3 vGeometricNormal;
flat out float vUvPerLength;
flat out mat3 vNormalMatrix;
flat out ivec4 vIds; // element, instance, row of links
#if PRIMVARS > 0
out vec4 vPrimvars[PRIMVARS];
#endif

void main() {
    Instance instance = instances[drawVertices.z + gl_InstanceID];
    int corner = cornerAt(gl_VertexID);
    vec3 p = vector3At(corner);
    mat3 linear = mat3(instance.objectToWorld);
    mat3 normalMatrix = mat3(instance.normalToWorld);
    vNormalMatrix = normalMatrix;
    vObjectPosition = p;
    vPosition = (instance.objectToWorld * vec4(p, 1.0)).xyz;
    vec3 ng = normalMatrix * vector3At(corner + 14);
    vGeometricNormal = ng / max(length(ng), 1e-30);
    vNormal = normalMatrix * vector3At(corner + 3);
    vTangent = linear * vector3At(corner + 6);
    vBitangent = linear * vector3At(corner + 9);
    vUvPerLength = vertices[corner + 12] / max(instance.normalToWorld[3].w, 1e-20);
    vIds = ivec4(floatBitsToInt(vertices[corner + 13]), instance.ids.x, instance.ids.yz);
#if PRIMVARS > 0
    for (int i = 0; i < PRIMVARS; ++i)
        vPrimvars[i] = vec4(vector3At(corner + 17 + 4 * i), vertices[corner + 20 + 4 * i]);
#endif
#ifdef SHADOW
    gl_Position = worldToMap * vec4(vPosition, 1.0);
    if (!isLinked(instance.ids.y, category)) gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // clipped
#else
    gl_Position = worldToClip * vec4(vPosition, 1.0);
#endif
}
