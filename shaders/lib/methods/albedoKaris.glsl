// SPDX-License-Identifier: Apache-2.0
// Karis 2014, "Physically Based Shading on Mobile": scale and bias on the reflectance at normal
// incidence, for a curve that rises to 1. From outside only; knows no colour at grazing angles.
PATINA_FN vec2 karisScaleBias(float mu, float alpha) {
    float roughness = sqrt(alpha);
    vec4 r =
        vec4(-1.0f, -0.0275f, -0.572f, 0.022f) * roughness + vec4(1.0f, 0.0425f, 1.04f, -0.04f);
    float a = min(r.x * r.x, exp2(-9.28f * mu)) * r.x + r.y;
    // The fit's bias is below 0 for the roughest lobes, which an albedo must not be.
    return max(vec2(-1.04f, 1.04f) * a + vec2(r.z, r.w), vec2(0.0f));
}
