// SPDX-License-Identifier: Apache-2.0
// Worley (cellular) noise of MaterialX 1.39: distances to the nearest of one point per cell
// (Worley 1996). Needs patterns/noise.glsl.

// distances: to the nearest three points, nearest first. nearest: offset from p to the nearest.
struct WorleyHit {
    vec3 distances;
    vec3 nearest;
};

PATINA_FN WorleyHit worleyNothing() {
    WorleyHit hit;
    hit.distances = vec3(1e6f);
    hit.nearest = vec3(0.0f);
    return hit;
}

// Takes a further point at squared distance d into account.
PATINA_FN WorleyHit worleyInsert(WorleyHit hit, vec3 offset) {
    float d = dot(offset, offset);
    vec3 e = hit.distances;
    hit.nearest = select(offset, hit.nearest, d < e.x);
    hit.distances = vec3(min(d, e.x), clamp(d, e.x, e.y), clamp(d, e.y, e.z));
    return hit;
}

PATINA_FN WorleyHit worleySearch2(vec2 p, float jitter) {
    vec2 cell = vec2(floor(p.x), floor(p.y));
    WorleyHit hit = worleyNothing();
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y) {
            vec2 at = vec2(float(x), float(y));
            vec3 r = (noiseCellTriple2(cell + at) - vec3(0.5f)) * jitter + vec3(0.5f);
            hit = worleyInsert(
                hit, vec3(at.x + r.x - (p.x - cell.x), at.y + r.y - (p.y - cell.y), 0.0f));
        }
    return hit;
}

PATINA_FN WorleyHit worleySearch3(vec3 p, float jitter) {
    vec3 cell = vec3(floor(p.x), floor(p.y), floor(p.z));
    WorleyHit hit = worleyNothing();
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                vec3 at = vec3(float(x), float(y), float(z));
                vec3 r = (noiseCellTriple3(cell + at) - vec3(0.5f)) * jitter + vec3(0.5f);
                hit = worleyInsert(hit, at + r - (p - cell));
            }
    return hit;
}

// style: 0 gives distances, 1 a random number per cell. The first channel is the scalar node.
PATINA_FN vec3 worleyNoise2(vec2 p, float jitter, int style) {
    WorleyHit hit = worleySearch2(p, jitter);
    vec3 solid = noiseCellTriple2(p + vec2(hit.nearest.x, hit.nearest.y));
    return select(solid, sqrt(hit.distances), style == 1);
}

PATINA_FN vec3 worleyNoise3(vec3 p, float jitter, int style) {
    WorleyHit hit = worleySearch3(p, jitter);
    return select(noiseCellTriple3(p + hit.nearest), sqrt(hit.distances), style == 1);
}

// The scalar node's random number of a cell is another than that of the vectors.
PATINA_FN float worleyScalar2(vec2 p, float jitter, int style) {
    WorleyHit hit = worleySearch2(p, jitter);
    float solid = noiseCell2(p + vec2(hit.nearest.x, hit.nearest.y));
    return select(solid, sqrt(hit.distances.x), style == 1);
}

PATINA_FN float worleyScalar3(vec3 p, float jitter, int style) {
    WorleyHit hit = worleySearch3(p, jitter);
    return select(noiseCell3(p + hit.nearest), sqrt(hit.distances.x), style == 1);
}
