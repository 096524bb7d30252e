// SPDX-License-Identifier: Apache-2.0
// Lobes as a whole: which of them is drawn, and the sums over all of them.

// BSDF times |cos wi| of all lobes that are no delta, and the density with which sampling finds wi.
struct MaterialEval {
    vec3 diffuse;  // part of the diffuse lobes
    vec3 specular; // part of all other lobes
    float pdf;
};

PATINA_FN MaterialEval materialEvalNone() {
    MaterialEval e;
    e.diffuse = vec3(0.0f);
    e.specular = vec3(0.0f);
    e.pdf = 0.0f;
    return e;
}

// Light leaks through no surface because of an interpolated or mapped normal: the geometric normal and
// that of the lobe must agree whether wi reflects.
PATINA_FN bool isReflected(vec3 wi, vec3 geometricNormal, bool woOutside) {
    return (dot(wi, geometricNormal) > 0.0f) == woOutside;
}
// woZ, wiZ: in the frame of the lobe.
PATINA_FN bool lobeAgrees(float woZ, float wiZ, bool reflects) {
    return ((wiZ > 0.0f) == (woZ >= 0.0f)) == reflects;
}

PATINA_FN void addLobe(PATINA_INOUT(MaterialEval) sum, bool counts, bool diffuse, vec3 weight, float chance,
                       LobeEval e) {
    if (!counts) return;
    vec3 more = select(sum.diffuse, sum.specular, diffuse) + weight * e.value;
    if (diffuse)
        sum.diffuse = more;
    else
        sum.specular = more;
    sum.pdf += chance * e.pdf;
}

PATINA_FN bool hasWeight(vec3 weight) {
    return luminance(weight) > 0.0f;
}
// A lobe's weight in the draw, before the sum over all of them divides it. A lone lobe needs no share. One
// whose albedo is 0 at wo (below its horizon) is never drawn, and evaluates to 0.
PATINA_FN float selectionShare(vec3 weight, vec3 albedo, bool alone) {
    return select(1.0f, luminance(weight * albedo), alone);
}

// The lobe that is drawn: the first whose chance and those before it exceed u, of those that have a
// chance. Rounding may leave u beyond all of them; then it is the last.
struct Selection {
    int lobe; // -1 none
    float below;
    bool found;
};
PATINA_FN Selection selectionNone() {
    Selection s;
    s.lobe = -1;
    s.below = 0.0f;
    s.found = false;
    return s;
}
PATINA_FN void selectLobe(PATINA_INOUT(Selection) s, int lobe, float chance, float u) {
    if (s.found || !(chance > 0.0f)) return;
    s.lobe = lobe;
    s.below += chance;
    s.found = u < s.below;
}

// The contribution of a drawn lobe by its own sample, to which the others add what they have there. A delta
// stands alone.
PATINA_FN vec3 drawnValue(vec3 weight, vec3 sampleWeight, float samplePdf) {
    return weight * (sampleWeight * samplePdf);
}
PATINA_FN vec3 drawnAlone(vec3 weight, vec3 sampleWeight, float chance) {
    return weight * sampleWeight / chance;
}
