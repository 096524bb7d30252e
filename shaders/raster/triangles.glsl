// SPDX-License-Identifier: Apache-2.0
// Values of whole triangles: pulled by the fragment stage, so that corners can share vertices.
struct Triangle {
    vec4 dPdu;   // object space; w: sqrt of texture area per area
    vec4 dPdv;   // w: bits of the authored face
    vec4 normal; // geometric, object space, not of unit length
};
layout(std430, binding = 2) readonly buffer Triangles { Triangle triangles[]; };
