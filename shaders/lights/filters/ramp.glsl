// SPDX-License-Identifier: Apache-2.0
// Ramps change light by a distance. Their curves are tables of the hosts.

const int RAMP_TO_LIGHT = 0;  // of the light from the point
const int RAMP_LINEAR = 1;    // along the filter's -z
const int RAMP_SPHERICAL = 2; // from its origin
const int RAMP_RADIAL = 3;    // from its z axis

const int CURVE_LINEAR = 0;
const int CURVE_CONSTANT = 1;
const int CURVE_CATMULL_ROM = 2;
const int CURVE_BSPLINE = 3;

// 0 to 1 between the ramp's ends. point: in the filter's space; reach: distance of the light in the world
PATINA_FN float rampPlace(int type, vec3 point, float reach, float start, float end) {
    float at = reach;
    if (type == RAMP_LINEAR) at = -point.z;
    if (type == RAMP_SPHERICAL) at = length(point);
    if (type == RAMP_RADIAL) at = sqrt(point.x * point.x + point.y * point.y);
    if (!(end > start)) return select(1.0f, 0.0f, at >= start);
    return clamp((at - start) / (end - start), 0.0f, 1.0f);
}

// Shares of four knots of a curve: the one before an interval, its two ends, and the one after it. t: within it, 0..1
PATINA_FN vec4 curveWeights(int kind, float t) {
    float s = 1.0f - t;
    if (kind == CURVE_CONSTANT) return vec4(0.0f, 1.0f, 0.0f, 0.0f);
    if (kind == CURVE_CATMULL_ROM)
        return vec4(-0.5f * t * s * s, 1.0f + t * t * (1.5f * t - 2.5f), 0.5f * t * (1.0f + t * (4.0f - 3.0f * t)),
                    -0.5f * t * t * s);
    if (kind == CURVE_BSPLINE)
        return vec4(s * s * s, 3.0f * t * t * t - 6.0f * t * t + 4.0f, 3.0f * s * s * s - 6.0f * s * s + 4.0f, t * t * t) *
               (1.0f / 6.0f);
    return vec4(0.0f, s, t, 0.0f);
}
