// SPDX-License-Identifier: Apache-2.0
// Latlong images around a dome, whose frame has y as its pole: +z is in the middle, -x at the right.

// From the left top corner, both 0 to 1; directions along the seam may be beyond by rounding.
PATINA_FN vec2 domeTexel(vec3 d) {
    return vec2(0.5f - atan(d.x, d.z) / TWO_PI, acos(clamp(d.y, -1.0f, 1.0f)) * INV_PI);
}

PATINA_FN vec3 domeDirection(vec2 at) {
    float longitude = (0.5f - at.x) * TWO_PI;
    float theta = at.y * PI;
    return vec3(sin(theta) * sin(longitude), cos(theta), sin(theta) * cos(longitude));
}
