// SPDX-License-Identifier: Apache-2.0
// Lambert transmission: MaterialX translucent_bsdf. Light leaves on the other side from wo, spread
// by the cosine, from either side. Reciprocal; eta is 1 because no medium is entered.

struct TranslucentLobe {
    vec3 color;
};

// color: transmittance.
PATINA_FN TranslucentLobe translucentSetup(vec3 color) {
    TranslucentLobe l;
    l.color = lobeColor(color);
    return l;
}

PATINA_FN LobeEval translucentEval(TranslucentLobe l, vec3 wo, vec3 wi) {
    float side = select(1.0f, -1.0f, wo.z >= 0.0f);
    LobeEval e;
    e.pdf = max(-wi.z * side, 0.0f) * INV_PI;
    e.value = l.color * e.pdf;
    return e;
}

PATINA_FN LobeSample translucentSample(TranslucentLobe l, vec3 wo, vec3 u) {
    LobeSample s = lobeSampleNone();
    vec3 w = sampleCosineHemisphere(vec2(u.x, u.y));
    s.wi = vec3(w.x, w.y, -w.z * select(1.0f, -1.0f, wo.z >= 0.0f));
    s.pdf = w.z * INV_PI;
    bool found = w.z > 0.0f;
    s.weight = select(l.color, vec3(0.0f), found);
    s.event = select(LOBE_TRANSMIT, 0, found);
    return s;
}

PATINA_FN vec3 translucentAlbedo(TranslucentLobe l, PATINA_UNUSED(vec3, wo)) {
    return l.color;
}

PATINA_FN vec3 lobeFix(PATINA_INOUT(TranslucentLobe) l, PATINA_UNUSED(vec3, wo), PATINA_OUT(vec3) albedo) {
    albedo = l.color;
    return vec3(1.0f);
}
