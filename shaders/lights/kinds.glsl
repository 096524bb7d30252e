// SPDX-License-Identifier: Apache-2.0
// Kinds of lights beside the shapes of shape.glsl, whose numbers are below these.
const int LIGHT_POINT = 100;
const int LIGHT_DISTANT = 101;
const int LIGHT_DOME = 102;
// Found by their samples only: further samples of a dome, lines, glowing triangles.
const int LIGHT_MORE_DOME = 103;
const int LIGHT_LINE = 104;
const int LIGHT_TRIANGLE = 105;
const int LIGHT_MESH = 106; // all triangles of a mesh

// Flags of a light on a GPU.
const int LIGHT_AT_PLACE = 1;   // its sample is a position, not a direction
const int LIGHT_IS_DELTA = 2;   // no sample of a BSDF finds it
const int LIGHT_IS_SEEN = 4;    // by the camera
const int LIGHT_HAS_CONE = 8;   // shaping cuts it off
const int LIGHT_OF_DOME = 16;   // the dominant light of a dome
const int LIGHT_TWO_SIDED = 32; // a triangle
// From this bit on: where its filters stand in the tables of lights, plus 1; 0: it has none.
const int LIGHT_FILTERS_SHIFT = 8;
