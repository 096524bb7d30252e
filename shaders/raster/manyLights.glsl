// SPDX-License-Identifier: Apache-2.0
// Scenes of many lights: each pixel takes a few of those that are not everywhere, chosen by an estimate of what they send.
// Each cell of space has a list of some of the lights, with weights whose expectation is 1 for every light of the scene
// (hdDelegate/raster/samples/lightCells.h). A pixel draws lights of its cell's list by systematic sampling: each with a
// probability in proportion to its estimate at the point, and surely where the pixel would take it more than once.
#include "shaders/lights/estimate.glsl"
#define PATINA_ROW(vector, type, number, initial) vec3 vector; type number;
#define PATINA_NUMBERS(type, a, b, c, d, initial) type a, b, c, d;
struct LightEstimate {
#include "shaders/lights/estimateFields.glsl"
};
#undef PATINA_ROW
#undef PATINA_NUMBERS
layout(std140, binding = 5) uniform LightEstimates { LightEstimate estimates[208]; }; // of lights
layout(binding = 26) uniform usampler2D lightLists;

const int LISTED = 16;       // entries of a list, as LightCells has it
const int LISTS_A_ROW = 64;  // of the texture
const float NARROW = 16.0;   // density of directions above which the BSDF's samples look at all lights, not at those of a list

int listCell = 0;
// Of a choice: what it is for, the next entry, and the sums of systematic sampling.
vec3 choicePlace, choiceNormal;
int choiceAt;
float choiceScale, choiceSum, choiceNext;

// The light of an entry, and how often it counts: a float without its last bits, which hold the light's number.
int listed(int k, out float share) {
    uint entry = texelFetch(lightLists, ivec2(listCell % LISTS_A_ROW * LISTED + k, listCell / LISTS_A_ROW), 0).x;
    share = uintBitsToFloat(entry & 0xffffff00u);
    return int(entry & 0xffu);
}

float estimateOf(int i, vec3 p, vec3 n) {
    if (!isLinked(vIds.z, lights[i].category)) return 0.0;
    vec3 d = estimateFrom(estimates[i].place, estimates[i].along, p);
    float away = max(length(d), 1e-20), spread = estimates[i].radius / away;
    vec3 w = d / away;
    float facing = n == vec3(0.0) ? 1.0 : clamp(spread - dot(n, w), 0.1, 1.0);
    return estimateAt(estimates[i].power, estimates[i].radius, estimates[i].least, away) * facing *
           estimateTowards(dot(w, estimates[i].axis), estimates[i].start, estimates[i].slope, spread);
}

// n: zero where light may come from all sides; u: where in the cells the point's list is taken, and what is taken of it.
void beginChoice(vec3 p, vec3 n, vec4 u) {
    vec3 sides = vec3(cellsX, cellsY, cellsZ);
    vec3 cell = clamp(floor((p - cellsLow) * cellsPerUnit + u.xyz - 0.5), vec3(0.0), sides - 1.0);
    listCell = (int(cell.z) * cellsY + int(cell.y)) * cellsX + int(cell.x);
    choicePlace = p;
    choiceNormal = n;
    choiceAt = 0;
    choiceSum = 0.0;
    choiceNext = u.w;
    float sum = 0.0;
    for (int k = 0; k < LISTED; ++k) {
        float share;
        int i = listed(k, share);
        sum += share * estimateOf(i, p, n);
    }
    choiceScale = float(lightsChosen) / max(sum, 1e-30);
}

// The next light of the choice, -1 where there is none. share: how often it counts
int nextChosen(out float share) {
    int chosen = -1;
    share = 0.0;
    while (choiceAt < LISTED && chosen < 0) {
        int i = listed(choiceAt++, share);
        float chance = min(choiceScale * share * estimateOf(i, choicePlace, choiceNormal), 1.0);
        choiceSum += chance;
        if (choiceSum > choiceNext) {
            choiceNext += 1.0;
            share /= chance;
            chosen = i;
        }
    }
    return chosen;
}

bool mayMeet(int i, vec3 origin, vec3 direction) {
    vec3 v = estimates[i].place - origin;
    float t = dot(v, direction);
    vec3 beside = v - t * direction; // not the difference of squares, which small lights far away would be lost in
    float radius = 1.01 * estimates[i].radius + 1e-5 * abs(t);
    return estimates[i].found > 0.0 && t > -radius && dot(beside, beside) <= radius * radius;
}

// The next light that a ray from the point may meet, -1 where there is none. at: how many were looked at; all: not just
// those of the list, of which each counts as often as `share` says
int nextAlong(inout int at, bool all, vec3 origin, vec3 direction, out float share) {
    int found = -1, end = all ? lightsFound : firstShared + LISTED;
    share = 1.0;
    while (at < end && found < 0) {
        int i = at;
        if (at >= firstShared) {
            float counts;
            int there = listed(at - firstShared, counts);
            i = all ? at : there;
            share = all ? 1.0 : counts;
        }
        ++at;
        if (i < firstShared || (share > 0.0 && mayMeet(i, origin, direction))) found = i;
    }
    return found;
}
