// SPDX-License-Identifier: Apache-2.0
// What a list of draws says of the draw that a vertex belongs to.
struct DrawRecord {
    ivec4 info; // bits of the prim's primvars, prim id, flags of RasterShape, where its InstanceValues begin, plus 1; 0: none
    ivec4 rows; // random numbers: what triangles are counted from; first of Triangles; of Primvars; of vertices
};
layout(std430, binding = 12) readonly buffer Draws { DrawRecord draws[]; };
layout(location = 18) uniform int firstDraw; // of the call
