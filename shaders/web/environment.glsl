// What comes from infinitely far: a map around a vertical axis, and an even part.
uniform sampler2D environmentMap;
uniform mat3 worldToEnvironment;
uniform vec3 environmentScale; // 0: none
uniform vec3 ambient;

vec2 latlong(vec3 d) {
    float u = 0.5 - atan(d.x, d.z) / 6.28318530717958647693;
    return vec2(u, acos(clamp(d.y, -1.0, 1.0)) * 0.318309886183790671538);
}

vec3 environmentAt(vec3 w, float lod) {
    vec3 map = textureLod(environmentMap, latlong(worldToEnvironment * w), lod).rgb;
    return environmentScale * map + ambient;
}
