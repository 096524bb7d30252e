// SPDX-License-Identifier: Apache-2.0
// Surfaces that none of a light's maps shows, see ShadowView::Own. Those inside of a sphere light: its
// samples are inside, too, but it shines from its surface. And what lies in the plane of a flat
// emitter: seen from a place on it, it is a line, which rounding makes a half of all that is seen.
layout(location = 11) uniform mat4 worldToLight;
layout(location = 12) uniform int ownShape; // 1 sphere, 2 plane

bool isOfLight(vec3 p) {
    vec3 q = (worldToLight * vec4(p, 1.0)).xyz;
    return ownShape == 1 ? dot(q, q) < 1.0 : ownShape == 2 && abs(q.z) < 1.0;
}
