// SPDX-License-Identifier: Apache-2.0
// Results of every lobe. Directions are unit vectors in the local frame (z = shading normal, x =
// tangent) and point away from the surface. wo is where the path comes from, wi where it goes to.

// Bits of LobeSample.event.
const int LOBE_REFLECT = 1;
const int LOBE_TRANSMIT = 2;
const int LOBE_DELTA = 4;

// Scatter modes, as in the MaterialX nodes. R and T are bits of RT.
const int SCATTER_R = 1;
const int SCATTER_T = 2;
const int SCATTER_RT = 3;

// value: BSDF times |cos wi|; pdf: density with which the lobe's sample function draws wi, per
// solid angle. Both are 0 for delta parts.
struct LobeEval {
    vec3 value;
    float pdf;
};

// weight: BSDF times |cos wi| over the density. pdf: per solid angle, or the discrete probability
// of the choice when LOBE_DELTA is set. event: 0 when no direction was found (weight 0, stop the
// path). eta: n(wo side) / n(wi side) for transmission, else 1.
struct LobeSample {
    vec3 wi;
    vec3 weight;
    float pdf;
    int event;
    float eta;
};

PATINA_FN LobeEval lobeEvalNone() {
    LobeEval e;
    e.value = vec3(0.0f);
    e.pdf = 0.0f;
    return e;
}

PATINA_FN LobeSample lobeSampleNone() {
    LobeSample s;
    s.wi = vec3(0.0f, 0.0f, 1.0f);
    s.weight = vec3(0.0f);
    s.pdf = 0.0f;
    s.event = 0;
    s.eta = 1.0f;
    return s;
}

// Input colours: finite and not negative.
PATINA_FN vec3 lobeColor(vec3 c) {
    return min(max(c, vec3(0.0f)), vec3(COLOR_MAX));
}

PATINA_FN float lobeMean(vec3 c) {
    return (c.x + c.y + c.z) * (1.0f / 3.0f);
}
