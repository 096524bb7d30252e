// Three facets that stand in for all that a view sees of isotropic GGX: the directional albedo of a
// reflection under any Fresnel curve F is about w.x F(c.x) + w.y F(c.y) + w.z F(c.z). For light from
// the thinner side; total reflection has a kink that three places miss.
// Written by shaders/bake/albedoFit.py. Over 32 x 32 cell centres of (cosine, root of alpha), ior
// 1.03 to 3, metals and Schlick's curve: RMSE 6.0e-05, largest error 1.0e-03.

struct FacetRule {
    vec3 c; // cosines between view and facet, in [0, 1]
    vec3 w; // weights; their sum is the albedo of a white mirror
};

PATINA_FN vec4 fitBend(vec4 z) {
    return z / sqrt(vec4(1.0f) + z * z);
}

// mu: cosine of the view, in [0, 1]. alpha: in [ALPHA_MIRROR, 1].
PATINA_FN FacetRule fitRule(float mu, float alpha) {
    float x0 = sqrt(mu);
    float x1 = sqrt(alpha);
    float x2 = mu / sqrt(mu * mu + alpha * alpha);
    vec4 h00 = vec4(0.2649722f, -1.567962f, -1.088347f, -2.648365f)
             + vec4(0.3471571f, 0.8928542f, -0.09742864f, -0.3137773f) * x0
             + vec4(1.255043f, 0.932362f, -0.07531572f, -1.705126f) * x1
             + vec4(-0.1037364f, -0.6717336f, -1.600357f, 2.598907f) * x2;
    h00 = fitBend(h00);
    vec4 h01 = vec4(0.5355738f, -0.06882807f, -0.227259f, 1.096263f)
             + vec4(0.9751704f, 0.9689177f, 1.720204f, 3.484382f) * x0
             + vec4(-2.259894f, -0.6521731f, -1.200823f, 1.83574f) * x1
             + vec4(-0.2328234f, 0.1030969f, -2.589504f, -0.003654324f) * x2;
    h01 = fitBend(h01);
    vec4 h10 = vec4(-3.397686f, 2.837926f, 3.049619f, 5.165411f)
             + vec4(-0.2916016f, 1.094382f, -3.721326f, -1.159401f) * h00.x
             + vec4(-1.174464f, -0.2832443f, 3.025555f, 0.3197672f) * h00.y
             + vec4(-3.79602f, 2.955192f, 0.5560354f, 1.358879f) * h00.z
             + vec4(-1.736514f, -0.9241015f, -3.904713f, 0.640686f) * h00.w
             + vec4(-0.8224584f, -0.2474436f, 0.1103152f, 0.2475035f) * h01.x
             + vec4(-0.9463381f, -1.549238f, -1.688342f, 1.734513f) * h01.y
             + vec4(0.6406937f, -0.02615956f, -1.250998f, -0.5641205f) * h01.z
             + vec4(-1.210064f, -0.8066842f, -0.573182f, -3.991081f) * h01.w;
    h10 = fitBend(h10);
    vec4 h11 = vec4(-0.4838456f, -3.926533f, 0.9813162f, -0.3019391f)
             + vec4(8.97383f, -1.790518f, -0.6350235f, 1.375891f) * h00.x
             + vec4(1.13716f, -2.041701f, -0.8233142f, 1.043773f) * h00.y
             + vec4(21.93063f, 2.694122f, 1.076367f, -1.068627f) * h00.z
             + vec4(-4.606572f, -1.040031f, 0.2359992f, -0.1439786f) * h00.w
             + vec4(3.690575f, 1.204213f, 0.7281153f, -0.5317507f) * h01.x
             + vec4(-0.0153336f, -0.2125885f, -0.3085472f, -0.07841349f) * h01.y
             + vec4(-3.827217f, 0.1028406f, -0.02349153f, -0.003322796f) * h01.z
             + vec4(4.84541f, 4.788428f, 0.8646335f, -1.442967f) * h01.w;
    h11 = fitBend(h11);
    vec3 lean = vec3(1.056288f, 24.13645f, 7.24058f)
             + vec3(-0.3408704f, 1.448106f, 0.7171253f) * h10.x
             + vec3(1.297146f, 5.39885f, 94.71892f) * h10.y
             + vec3(0.9779124f, -0.02144821f, -7.497006f) * h10.z
             + vec3(0.00603082f, 3.619665f, 95.18452f) * h10.w
             + vec3(2.043276f, 21.72325f, 1.064047f) * h11.x
             + vec3(0.5766073f, 4.453829f, 1.032733f) * h11.y
             + vec3(-0.1250583f, 0.2147411f, -1.342351f) * h11.z
             + vec3(-0.3277975f, -0.05921143f, -0.1669696f) * h11.w;
    vec3 side = vec3(22.56142f, -47.28203f, -1.395688f)
             + vec3(-0.353605f, 0.3937426f, -1.113796f) * h10.x
             + vec3(34.70946f, -68.08457f, -92.71438f) * h10.y
             + vec3(0.3643122f, 0.3129305f, 5.581972f) * h10.z
             + vec3(35.70748f, -64.83567f, -97.79931f) * h10.w
             + vec3(19.02654f, -44.52146f, -1.78438f) * h11.x
             + vec3(4.000047f, -7.983354f, 6.893239f) * h11.y
             + vec3(2.302213f, -5.592776f, 0.7134346f) * h11.z
             + vec3(1.368578f, -3.634547f, -0.1916907f) * h11.w;
    vec3 w = vec3(0.4465176f, 0.1144051f, 0.2757526f)
             + vec3(0.01372322f, -0.2563644f, 0.03460131f) * h10.x
             + vec3(-0.5288015f, 0.9598324f, -0.0987646f) * h10.y
             + vec3(0.6621215f, -0.8405979f, 0.0236836f) * h10.z
             + vec3(0.002294211f, 0.03046996f, -0.007849185f) * h10.w
             + vec3(0.08137626f, 0.1232581f, 0.3361904f) * h11.x
             + vec3(0.482252f, -0.5099425f, 0.0176051f) * h11.y
             + vec3(-0.02594699f, 0.3637711f, 1.124975f) * h11.z
             + vec3(-0.1159235f, -0.2472484f, 1.083264f) * h11.w;
    // A facet that leans by `lean` towards the view and `side` across it, in slopes over alpha.
    float s = alpha * safeSqrt(1.0f - mu * mu);
    vec3 slope2 = (lean * lean + side * side) * (alpha * alpha);
    FacetRule r;
    r.c = min(max((vec3(mu) + lean * s) / sqrt(vec3(1.0f) + slope2), vec3(0.0f)), vec3(1.0f));
    r.w = w;
    return r;
}
