// SPDX-License-Identifier: Apache-2.0
// Numbers of a material at one point, one query per invocation; see hdDelegate/raster/scene/rasterBsdf.h.
layout(local_size_x = 1) in;
layout(std430, binding = 0) readonly buffer Queries { vec4 queries[]; };
layout(std430, binding = 6) writeonly buffer Answers { vec4 answers[]; };

void main() {
    int i = 3 * int(gl_GlobalInvocationID.x);
    point.position = point.objectPosition = vec3(probeUv.z != 0.0 ? probeUv.xy : vec2(0.0), 0.0);
    point.geometricNormal = point.normal = vec3(0.0, 0.0, 1.0);
    point.tangent = vec3(1.0, 0.0, 0.0);
    point.bitangent = vec3(0.0, 1.0, 0.0);
    point.view = queries[i].xyz;
    point.objectToWorldNormal = mat3(1.0);
    point.lengthPerUv = 1.0;
    point.uvFootprint = 0.0;
    point.seed = 0u;
    vec3 passes;
    float presence = materialPresence(passes);
    materialSetup();
    MaterialEval e = materialEval(queries[i + 1].xyz);
    vec4 u = queries[i + 2];
    bool met = u.w < presence;
    MaterialSample s = materialSample(u.xyz, met ? min(u.w / presence, 1.0 - 1.0 / 16777216.0) : 0.0);
    s.pdf *= presence;
    if (!met) {
        s.wi = -point.view;
        s.weight = passes;
        s.pdf = 1.0 - presence;
        s.event = LOBE_TRANSMIT + LOBE_DELTA;
    }
    int o = 6 * int(gl_GlobalInvocationID.x);
    answers[o] = vec4(e.diffuse, e.pdf) * presence;
    answers[o + 1] = vec4(e.specular * presence, presence);
    answers[o + 2] = vec4(s.wi, float(s.event));
    answers[o + 3] = vec4(s.weight, s.pdf);
    answers[o + 4] = vec4(materialAlbedo() * presence + passes * (1.0 - presence), 0.0);
    answers[o + 5] = vec4(materialEmission(point.view), 0.0);
}
