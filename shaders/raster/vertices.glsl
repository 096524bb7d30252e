// Vertices are pulled from a buffer of floats: three corners per triangle.
layout(std430, binding = 2) readonly buffer Vertices { float vertices[]; };
struct Instance {
    mat4 objectToWorld;
    mat4 normalToWorld; // w of the last column: cube root of the determinant
    ivec4 ids; // instance, row of links
};
layout(std430, binding = 3) readonly buffer Instances { Instance instances[]; };
layout(location = 0) uniform ivec4 drawVertices; // first float, floats per corner, first instance, flags
const int DRAW_FLIPS = 1;   // the transform mirrors
const int DRAW_FACETED = 2; // no normals

int cornerAt(int vertex) {
    return drawVertices.x + vertex * drawVertices.y;
}
vec3 vector3At(int i) {
    return vec3(vertices[i], vertices[i + 1], vertices[i + 2]);
}
