// What is inside of a sphere or cylinder light is drawn in none of its maps: its samples are inside, too,
// but it shines from its surface.
layout(location = 11) uniform mat4 worldToLight; // to the coordinates of the light's shape
layout(location = 12) uniform int lightShape;    // 0: none, 1: sphere, 2: cylinder

bool isInsideLight(vec3 p) {
    if (lightShape == 0) return false;
    vec3 q = (worldToLight * vec4(p, 1.0)).xyz;
    if (lightShape == 1) return dot(q, q) < 1.0;
    return abs(q.x) < 0.5 && dot(q.yz, q.yz) < 1.0;
}
