// What is inside of a sphere light is drawn in none of its maps: its samples are inside, too, but it
// shines from its surface.
layout(location = 11) uniform mat4 worldToLight; // to the sphere's coordinates
layout(location = 12) uniform int isSphereLight;

bool isInsideLight(vec3 p) {
    vec3 q = (worldToLight * vec4(p, 1.0)).xyz;
    return isSphereLight != 0 && dot(q, q) < 1.0;
}
