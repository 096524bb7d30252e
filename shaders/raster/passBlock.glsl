// What all passes know. Binding points: uniform blocks 0 pass, 1 parameters of a material; storage
// 2 vertices, 3 instances, 4 lights, 5 shadow matrices, 7 albedo tables; textures from 16 on:
// 16 dome, 17 its density, 18 shadow maps.
layout(std140, binding = 0) uniform Pass {
    mat4 worldToClip;
    mat4 clipToWorld;
    vec4 eye;       // w: 1 perspective, 0 orthographic
    vec4 forward;   // view direction of the camera; w: angle or width of a pixel
    ivec4 counts;   // lights, BSDF samples, index of the pass, seed
    vec4 extra;    // x: texels of the dome's image, y: exposure factor, z: passes that will have been taken
    mat4 domeToWorld; // rotation
    vec4 dome;      // radiance factor; w: 1 there is a dome
    ivec4 domeInfo; // x: samples of the dome, y: seen by the camera, z: levels, w: textured
};
