// SPDX-License-Identifier: Apache-2.0
// The kernels of particle fields: what a ray meets of one, and the harmonics of its radiance.

// In the space of a kernel it is exp(-r²/2) everywhere, or on the xy plane alone, or 1 on the unit disk of that plane.
const int SPLAT_ELLIPSOID = 0;
const int SPLAT_SURFLET = 1;
const int SPLAT_CONSTANT_SURFLET = 2;

// A kernel ends where its alpha falls below this. It then lacks the share SPLAT_CUT / opacity of its integral over
// the image: of a Gaussian exp(-r²/2) as much lies outside of r as it is there.
const float SPLAT_CUT = 1.0f / 1024.0f;
// What kernels let through counts as nothing below this.
const float SPLAT_END = 1e-4f;

// The point of a ray where a kernel is densest (Knoll et al. 2021; Moenne-Loccoz et al. 2024): of a flat one, that of its
// plane.
struct SplatPoint {
    float distance; // along the ray, in lengths of its direction
    float away;     // square of the distance from the middle, in standard deviations
};

// toUnit: into the space of the kernel.
PATINA_FN SplatPoint splatPoint(int shape, vec3 center, PATINA_IN(mat3) toUnit, vec3 origin, vec3 direction) {
    vec3 from = origin - center;
    // From the point nearest to the middle, so that no digits are lost on a long way.
    float nearest = -dot(from, direction) / dot(direction, direction);
    vec3 start = toUnit * (from + direction * nearest);
    vec3 along = toUnit * direction;
    bool isFlat = shape != SPLAT_ELLIPSOID;
    float further = select(-start.z / along.z, -dot(start, along) / dot(along, along), isFlat);
    vec3 densest = start + along * further;
    densest.z = select(0.0f, densest.z, isFlat);
    SplatPoint point;
    point.distance = nearest + further;
    point.away = select(1e38f, dot(densest, densest), isFlat && along.z == 0.0f);
    return point;
}

PATINA_FN float splatAlpha(int shape, float opacity, float away) {
    return select(opacity, opacity * exp(-0.5f * away), shape == SPLAT_CONSTANT_SURFLET);
}

const int SPLAT_BASIS = 16; // bands 0 to 3

struct SplatBasis {
    float at[SPLAT_BASIS];
};

// The real spherical harmonics of a direction as 3D Gaussian splatting has them (Kerbl et al. 2023): with the sign
// (-1)^m of Condon and Shortley, in each band from -l to l.
PATINA_FN SplatBasis splatBasis(vec3 d) {
    float x = d.x;
    float y = d.y;
    float z = d.z;
    float xx = x * x;
    float yy = y * y;
    float zz = z * z;
    SplatBasis basis;
    basis.at[0] = 0.28209479f;
    basis.at[1] = -0.48860251f * y;
    basis.at[2] = 0.48860251f * z;
    basis.at[3] = -0.48860251f * x;
    basis.at[4] = 1.09254843f * x * y;
    basis.at[5] = -1.09254843f * y * z;
    basis.at[6] = 0.31539157f * (2.0f * zz - xx - yy);
    basis.at[7] = -1.09254843f * x * z;
    basis.at[8] = 0.54627422f * (xx - yy);
    basis.at[9] = -0.59004359f * y * (3.0f * xx - yy);
    basis.at[10] = 2.89061144f * x * y * z;
    basis.at[11] = -0.45704579f * y * (4.0f * zz - xx - yy);
    basis.at[12] = 0.37317633f * z * (2.0f * zz - 3.0f * xx - 3.0f * yy);
    basis.at[13] = -0.45704579f * x * (4.0f * zz - xx - yy);
    basis.at[14] = 1.44530572f * z * (xx - yy);
    basis.at[15] = -0.59004359f * x * (xx - 3.0f * yy);
    return basis;
}
