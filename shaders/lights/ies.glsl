// SPDX-License-Identifier: Apache-2.0
// IES profiles: how much a luminaire shines which way. Hosts keep them as tables over directions, see table.glsl, or
// as the angles of the file.

// The azimuth for which a profile is read. x, y: the light's own, across its axis; away: from the light. The profile's
// nadir is the light's axis, and its azimuth is that of the direction in which the light comes in, as Hydra's own
// Embree renderer has it. Theta is the angle off the axis.
PATINA_FN float iesAzimuth(vec3 x, vec3 y, vec3 away) {
    return atan(-dot(away, y), -dot(away, x));
}
