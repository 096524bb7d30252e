#include "shaders/raster/passBlock.glsl"
#include "shaders/raster/vertices.glsl"

out vec3 vPosition;
out vec3 vObjectPosition;
out vec3 vNormal;
flat out vec3 vTangent;
flat out vec3 vBitangent;
flat out vec3 vGeometricNormal;
flat out float vUvPerLength;
flat out mat3 vNormalMatrix;
flat out ivec4 vIds; // element, instance, categories
#if PRIMVARS > 0
out vec4 vPrimvars[PRIMVARS];
#endif

void main() {
    Instance instance = instances[drawVertices.z + gl_InstanceID];
    int corner = cornerAt(gl_VertexID);
    vec3 p = vector3At(corner);
    mat3 linear = mat3(instance.objectToWorld);
    mat3 normalMatrix = transpose(inverse(linear));
    vNormalMatrix = normalMatrix;
    vObjectPosition = p;
    vPosition = (instance.objectToWorld * vec4(p, 1.0)).xyz;
    int first = cornerAt((gl_VertexID / 3) * 3);
    vec3 a = vector3At(first);
    vec3 b = vector3At(first + drawVertices.y);
    vec3 c = vector3At(first + 2 * drawVertices.y);
    vec3 ng = normalMatrix * cross(b - a, c - a);
    vGeometricNormal = ng / max(length(ng), 1e-30);
    vNormal = normalMatrix * vector3At(corner + 3);
    vTangent = linear * vector3At(corner + 6);
    vBitangent = linear * vector3At(corner + 9);
    float scale = pow(abs(determinant(linear)), 1.0 / 3.0);
    vUvPerLength = vertices[corner + 12] / max(scale, 1e-20);
    vIds = ivec4(floatBitsToInt(vertices[corner + 13]), instance.ids.x, instance.ids.yz);
#if PRIMVARS > 0
    for (int i = 0; i < PRIMVARS; ++i)
        vPrimvars[i] = vec4(vector3At(corner + 14 + 4 * i), vertices[corner + 17 + 4 * i]);
#endif
    gl_Position = worldToClip * vec4(vPosition, 1.0);
}
