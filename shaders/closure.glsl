// SPDX-License-Identifier: Apache-2.0
// How lobes become a material: shading frames, weights of layers, mixes and slabs, the choice of a lobe
// and sums over all of them, emission and media. Stands on shaders/lobes.glsl.
#include "shaders/closure/amounts.glsl"
#include "shaders/closure/frame.glsl"
#include "shaders/closure/layers.glsl"
#include "shaders/closure/slab.glsl"
#include "shaders/closure/selection.glsl"
#include "shaders/closure/emission.glsl"
#include "shaders/closure/medium.glsl"
