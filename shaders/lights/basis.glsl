// SPDX-License-Identifier: Apache-2.0
// Two unit vectors that complete a right-handed frame about a third (Duff et al. 2017).

struct LightBasis {
    vec3 x;
    vec3 y;
    vec3 z;
};

PATINA_FN LightBasis lightBasis(vec3 z) {
    LightBasis b;
    float side = select(-1.0f, 1.0f, floatBitsToInt(z.z) < 0); // of zeros, too
    float a = -1.0f / (side + z.z);
    float c = z.x * z.y * a;
    b.x = vec3(1.0f + side * z.x * z.x * a, side * c, -side * z.x);
    b.y = vec3(c, side + z.y * z.y * a, -z.y);
    b.z = z;
    return b;
}
