// SPDX-License-Identifier: Apache-2.0
// Barn doors and cookies stand in the plane z = 0 of their own space. Light crosses it on its way from the light to the
// point; what does not cross it is not filtered.

// Where the way from a point meets the plane. toLight: to the light's point, where reach is 1; any length where the light is
// at infinity and so is reach.
PATINA_FN bool openingCrossed(vec3 point, vec3 toLight, float reach, PATINA_OUT(vec3) at) {
    float t = -point.z / toLight.z;
    at = vec3(point.x + t * toLight.x, point.y + t * toLight.y, 0.0f);
    return t >= 0.0f && t <= reach;
}

// The analytic mode looks at the plane from a place on its axis, or along a direction, wherever the light is.
PATINA_FN vec3 openingAnalytic(vec3 point, bool directional, vec2 shear, float apex) {
    if (directional) return vec3(shear.x, shear.y, 1.0f);
    return vec3(0.0f, 0.0f, apex) - point;
}
