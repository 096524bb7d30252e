// SPDX-License-Identifier: Apache-2.0
// Three facets that stand in for all that a view sees of isotropic GGX: the directional albedo of a
// reflection under any Fresnel curve F is about w.x F(c.x) + w.y F(c.y) + w.z F(c.z). For light from
// the thinner side; total reflection has a kink that three places miss.
// Written by shaders/bake/albedoFit.py. Over 32 x 32 cell centres of (cosine, root of alpha), ior
// 1.03 to 3, metals and Schlick's curve: RMSE 8.6e-05, largest error 8.6e-04.

struct MicrofacetRule {
    vec3 c; // cosines between view and facet, in [0, 1]
    vec3 w; // weights; their sum is the albedo of a white mirror
};

PATINA_FN vec4 fitBend(vec4 z) {
    return z / sqrt(vec4(1.0f) + z * z);
}

// mu: cosine of the view, in [0, 1]. alpha: in [ALPHA_MIRROR, 1].
PATINA_FN MicrofacetRule fitRule(float mu, float alpha) {
    float x0 = sqrt(mu);
    float x1 = sqrt(alpha);
    float x2 = mu / sqrt(mu * mu + alpha * alpha);
    vec4 h00 = vec4(6.141068f, -2.027679f, 0.3262675f, -2.932894f)
             + vec4(-0.3910229f, 0.843919f, -0.5951372f, 0.8230126f) * x0
             + vec4(2.195826f, 1.267003f, -0.7495494f, -0.6398979f) * x1
             + vec4(-4.437022f, 0.008589443f, -0.1619209f, 1.835926f) * x2;
    h00 = fitBend(h00);
    vec4 h01 = vec4(-0.1001541f, 1.4517f, -2.706426f, 2.694107f)
             + vec4(0.9274949f, 0.4530991f, -6.328191f, 3.198897f) * x0
             + vec4(-2.027495f, -0.5194261f, 1.238133f, -0.9706057f) * x1
             + vec4(0.1887158f, 0.1579483f, -1.746863f, -0.8152699f) * x2;
    h01 = fitBend(h01);
    vec4 h10 = vec4(35.74935f, 3.502453f, -5.571898f, -6.003439f)
             + vec4(-16.89751f, 2.78742f, 6.469824f, -3.930926f) * h00.x
             + vec4(11.58356f, 0.3476786f, 0.1423768f, 0.6856434f) * h00.y
             + vec4(-3.423154f, 0.05023081f, 0.7464405f, 2.11327f) * h00.z
             + vec4(-7.854266f, 0.6120951f, 0.973061f, 0.1539344f) * h00.w
             + vec4(0.9065959f, -0.6021466f, -0.3971516f, -0.08773991f) * h01.x
             + vec4(-19.64351f, -5.943966f, -7.111702f, 14.92255f) * h01.y
             + vec4(2.178173f, -0.5448216f, 4.689925f, 1.049302f) * h01.z
             + vec4(3.710973f, -0.3979191f, 12.61315f, -0.8664772f) * h01.w;
    h10 = fitBend(h10);
    vec4 h11 = vec4(0.9815263f, 3.821749f, 14.36019f, 3.754295f)
             + vec4(-0.4755278f, -8.872968f, -20.07673f, 2.868149f) * h00.x
             + vec4(-0.5496097f, -0.2052298f, -0.4957603f, 0.63803f) * h00.y
             + vec4(-0.001621864f, -0.30173f, -0.06804108f, -0.8532012f) * h00.z
             + vec4(0.1233784f, 1.334839f, -4.023278f, 0.563161f) * h00.w
             + vec4(0.3333376f, -0.3236437f, 1.858478f, -0.4656514f) * h01.x
             + vec4(-3.584052f, 10.61254f, 4.499635f, -5.367263f) * h01.y
             + vec4(-0.3306972f, 7.006777f, -0.4416368f, -1.333131f) * h01.z
             + vec4(0.8378228f, 2.704618f, -0.921394f, -3.063476f) * h01.w;
    h11 = fitBend(h11);
    vec3 lean = vec3(-1.195008f, 13.76857f, 147.9651f)
             + vec3(-1.194259f, -15.14328f, -139.4776f) * h10.x
             + vec3(2.90471f, -4.244968f, 24.56022f) * h10.y
             + vec3(0.3155111f, 7.466349f, -33.88831f) * h10.z
             + vec3(0.1613512f, -0.06298693f, -7.630487f) * h10.w
             + vec3(-0.05549362f, 1.99295f, 2.568926f) * h11.x
             + vec3(-0.3408582f, -0.8003864f, 1.477813f) * h11.y
             + vec3(0.360368f, 0.04136283f, -0.2168213f) * h11.z
             + vec3(-0.5334877f, 0.0334519f, -4.109129f) * h11.w;
    vec3 side = vec3(-2.667721f, 42.71505f, -137.575f)
             + vec3(10.48267f, -47.92297f, 125.758f) * h10.x
             + vec3(8.417866f, 5.131116f, -60.97709f) * h10.y
             + vec3(-20.41045f, 6.180108f, 75.87344f) * h10.z
             + vec3(-3.409513f, -1.284451f, 9.514199f) * h10.w
             + vec3(1.645437f, 3.226096f, 3.721443f) * h11.x
             + vec3(2.525471f, 3.156251f, -5.730181f) * h11.y
             + vec3(-0.5968199f, 0.7513799f, 0.9591792f) * h11.z
             + vec3(3.226168f, 0.6167796f, 7.278503f) * h11.w;
    vec3 w = vec3(0.3686602f, 1.555204f, 2.346422f)
             + vec3(0.06956708f, -0.0737322f, -0.03071741f) * h10.x
             + vec3(0.5046092f, 0.4365209f, 0.2589222f) * h10.y
             + vec3(-0.01905919f, -0.04511403f, -0.01383997f) * h10.z
             + vec3(0.6793529f, -0.7115346f, 0.04891327f) * h10.w
             + vec3(0.4127651f, 1.767066f, 3.197002f) * h11.x
             + vec3(-0.1558964f, 0.5091929f, 0.05688059f) * h11.y
             + vec3(0.04086277f, 0.1238717f, 0.2437082f) * h11.z
             + vec3(-0.002548252f, -0.430177f, 0.6194595f) * h11.w;
    // A facet that leans by `lean` towards the view and `side` across it, in slopes over alpha.
    float s = alpha * safeSqrt(1.0f - mu * mu);
    vec3 slope2 = (lean * lean + side * side) * (alpha * alpha);
    MicrofacetRule r;
    r.c = min(max((vec3(mu) + lean * s) / sqrt(vec3(1.0f) + slope2), vec3(0.0f)), vec3(1.0f));
    r.w = w;
    return r;
}
