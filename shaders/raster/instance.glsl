// Attributes of the vertex stage: a vertex, and the instance that it is drawn for.
layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec4 inColumn0; // object to world, in columns; w: cube root of the determinant
layout(location = 3) in vec4 inColumn1;
layout(location = 4) in vec4 inColumn2;
layout(location = 5) in vec4 inColumn3;
layout(location = 6) in vec4 inNormal0; // the same for normals
layout(location = 7) in vec4 inNormal1;
layout(location = 8) in vec4 inNormal2;
layout(location = 9) in ivec4 inIds; // instance, row of links, -, -

vec3 worldPosition() {
    mat4 toWorld = mat4(vec4(inColumn0.xyz, 0.0), vec4(inColumn1.xyz, 0.0), vec4(inColumn2.xyz, 0.0),
                        vec4(inColumn3.xyz, 1.0));
    return (toWorld * vec4(inPosition, 1.0)).xyz;
}
