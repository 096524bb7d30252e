// SPDX-License-Identifier: Apache-2.0
// Ramps change light by a distance. Their curves are tables of the hosts.

const int RAMP_TO_LIGHT = 0;  // of the light from the point
const int RAMP_LINEAR = 1;    // along the filter's -z
const int RAMP_SPHERICAL = 2; // from its origin
const int RAMP_RADIAL = 3;    // from its z axis

// 0 to 1 between the ramp's ends. point: in the filter's space; reach: distance of the light in the world
PATINA_FN float rampPlace(int type, vec3 point, float reach, float start, float end) {
    float at = reach;
    if (type == RAMP_LINEAR) at = -point.z;
    if (type == RAMP_SPHERICAL) at = length(point);
    if (type == RAMP_RADIAL) at = sqrt(point.x * point.x + point.y * point.y);
    if (!(end > start)) return select(0.0f, 1.0f, at >= start);
    return clamp((at - start) / (end - start), 0.0f, 1.0f);
}
