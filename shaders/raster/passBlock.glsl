// SPDX-License-Identifier: Apache-2.0
// Data of all passes. Binding points: uniform blocks 0 pass, 1 parameters of a material; storage
// 2 vertices, 3 instances, 4 lights, 5 shadow matrices, 7 albedo tables, 8 tables of lights,
// 9 links, 10 sky cells; textures from 16 on: 16 domes, 17 their densities, 18 shadow maps,
// 19 maps of the sky's cells, 20 prefiltered domes, 21 to 24 what is behind (refraction.glsl).
layout(std140, binding = 0) uniform Pass {
    mat4 worldToClip;
    mat4 clipToWorld;
    vec4 eye;       // w: 1 perspective, 0 orthographic
    vec4 forward;   // view direction of the camera; w: angle or width of a pixel
    ivec4 counts;   // lights taken, BSDF samples, index of the pass, seed
    vec4 extra;     // x: texels of a dome's image, y: exposure factor, z: passes that will have been taken, w: extent of the scene
    ivec4 lightInfo; // x: lights that the background shows, y: highest level of domes, z: cells of the sky along a side (0 none), w: samples of filtered domes
    vec4 origin;     // all positions are relative to this place in the world
    vec4 range;      // along the camera's axis: x, from its near plane to that of worldToClip, y, to its far plane; z: planes
    vec4 clipPlanes[8]; // of the camera: what is behind one is not seen
    // Of lights: x, end of those that samples of the BSDF find; y, first whose sample is taken; z, first of
    // those of which each pixel takes one in w. In most passes: counts.x, 0, counts.x, 1.
    ivec4 look;
};
