// SPDX-License-Identifier: Apache-2.0
// Participating media: what a VDF says at one point. All coefficients are per scene unit, finite and
// not negative.

// The scattering is a sum of Henyey-Greenstein parts, so that an added or mixed VDF keeps the phase
// functions that it is made of.
const int MEDIUM_PHASES = 4;

struct MediumPhase {
    vec3 scattering;
    float anisotropy; // mean cosine, -1..1
};
struct Medium {
    vec3 absorption;
    vec3 emission; // radiance gained per scene unit
    MediumPhase phases[MEDIUM_PHASES];
    int phaseCount;
};

PATINA_FN Medium mediumNone() {
    Medium m;
    m.absorption = vec3(0.0f);
    m.emission = vec3(0.0f);
    for (int i = 0; i < MEDIUM_PHASES; ++i) {
        m.phases[i].scattering = vec3(0.0f);
        m.phases[i].anisotropy = 0.0f;
    }
    m.phaseCount = 0;
    return m;
}

PATINA_FN vec3 mediumScattering(Medium m) {
    vec3 sum = vec3(0.0f);
    for (int i = 0; i < MEDIUM_PHASES; ++i)
        if (i < m.phaseCount) sum += m.phases[i].scattering;
    return sum;
}

// Of more than MEDIUM_PHASES different parts the last two become one, with the mean anisotropy of both.
PATINA_FN void addScattering(PATINA_INOUT(Medium) m, vec3 scattering, float anisotropy) {
    float more = scattering.x + scattering.y + scattering.z;
    if (!(more > 0.0f)) return;
    float g = select(clamp(anisotropy, -1.0f, 1.0f), 0.0f, anisotropy == anisotropy);
    bool placed = false;
    for (int i = 0; i < MEDIUM_PHASES; ++i) {
        bool fits = i == m.phaseCount || (i < m.phaseCount && m.phases[i].anisotropy == g);
        if (!placed && fits) {
            m.phases[i].scattering += scattering;
            m.phases[i].anisotropy = g;
            m.phaseCount = max(m.phaseCount, i + 1);
            placed = true;
        }
    }
    if (placed) return;
    MediumPhase last = m.phases[MEDIUM_PHASES - 1];
    float share = more / (more + (last.scattering.x + last.scattering.y + last.scattering.z));
    last.anisotropy += (g - last.anisotropy) * share;
    last.scattering += scattering;
    m.phases[MEDIUM_PHASES - 1] = last;
}

PATINA_FN void addAbsorption(PATINA_INOUT(Medium) m, vec3 weight, vec3 absorption) {
    m.absorption += coefficient(weight * absorption);
}
PATINA_FN void addAnisotropic(PATINA_INOUT(Medium) m, vec3 weight, vec3 absorption, vec3 scattering,
                              float anisotropy) {
    addScattering(m, coefficient(weight * scattering), anisotropy);
    addAbsorption(m, weight, absorption);
}

// The phase functions of a medium together: by channel a share of each, of which one is drawn in
// proportion to the light that it scatters.
struct PhasePart {
    vec3 share;
    float anisotropy;
    float chance;
};
struct PhaseMixture {
    PhasePart parts[MEDIUM_PHASES];
    int count;
};

PATINA_FN float phaseShare(float part, float whole) {
    return select(part / whole, 0.0f, whole > 0.0f);
}
// throughput: of the light that is scattered.
PATINA_FN PhaseMixture phaseMixture(Medium m, vec3 throughput) {
    vec3 whole = mediumScattering(m);
    PhaseMixture p;
    p.count = m.phaseCount;
    float sum = 0.0f;
    for (int i = 0; i < MEDIUM_PHASES; ++i) {
        vec3 s = m.phases[i].scattering;
        p.parts[i].share =
            vec3(phaseShare(s.x, whole.x), phaseShare(s.y, whole.y), phaseShare(s.z, whole.z));
        p.parts[i].anisotropy = m.phases[i].anisotropy;
        p.parts[i].chance = select(dot(p.parts[i].share, throughput), 0.0f, i < m.phaseCount);
        sum += p.parts[i].chance;
    }
    for (int i = 0; i < MEDIUM_PHASES; ++i)
        if (i < m.phaseCount)
            p.parts[i].chance =
                select(p.parts[i].chance / sum, 1.0f / float(m.phaseCount), sum > 0.0f);
    return p;
}
// wo, wi: unit vectors in any common frame. value: normalised to 1.
PATINA_FN LobeEval phaseMixtureEval(PhaseMixture p, vec3 wo, vec3 wi) {
    LobeEval sum = lobeEvalNone();
    for (int i = 0; i < MEDIUM_PHASES; ++i)
        if (i < p.count) {
            PhaseHenyeyGreensteinLobe phase = phaseHenyeyGreensteinSetup(p.parts[i].anisotropy);
            float f = phaseHenyeyGreensteinEval(phase, wo, wi).pdf;
            sum.value += p.parts[i].share * f;
            sum.pdf += p.parts[i].chance * f;
        }
    return sum;
}
// u: for the direction. uPart: for the phase function.
PATINA_FN LobeSample phaseMixtureSample(PhaseMixture p, vec3 wo, vec3 u, float uPart) {
    LobeSample s = lobeSampleNone();
    Selection drawn = selectionNone();
    for (int i = 0; i < MEDIUM_PHASES; ++i)
        if (i < p.count) selectLobe(drawn, i, p.parts[i].chance, uPart);
    if (drawn.lobe < 0) return s;
    PhaseHenyeyGreensteinLobe phase = phaseHenyeyGreensteinSetup(p.parts[drawn.lobe].anisotropy);
    s.wi = normalize(phaseHenyeyGreensteinSample(phase, wo, u).wi);
    LobeEval e = phaseMixtureEval(p, wo, s.wi);
    s.pdf = e.pdf;
    if (e.pdf > 0.0f) s.weight = e.value / e.pdf;
    s.event = LOBE_TRANSMIT;
    return s;
}
