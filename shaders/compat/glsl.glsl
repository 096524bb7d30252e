// SPDX-License-Identifier: Apache-2.0
// GLSL side of the shader dialect (GLSL 4.3 and up; GLSL ES 3.0 with PATINA_ALBEDO_TABLE_FETCH).
// Include it first, after #version. Names missing here are missing from the dialect.

#define PATINA_FN
#define PATINA_FN_RARE
#define PATINA_IN(T) T
#define PATINA_OUT(T) out T
#define PATINA_INOUT(T) inout T
#define PATINA_UNUSED(T, name) T name

// Constants before this file may state facts that hold for all lobes of a shader. Drivers do not find out by
// themselves, and take four times as long to compile code that never runs.
// Whether lobes have the energy factors of their wo.
#ifndef PATINA_ENERGY_KNOWN
#define PATINA_ENERGY_KNOWN(known) (known)
#endif
// One of COMPENSATE_*.
#ifndef PATINA_COMPENSATE
#define PATINA_COMPENSATE(compensate) (compensate)
#endif
// One of ALBEDO_*.
#ifndef PATINA_ALBEDO_METHOD
#define PATINA_ALBEDO_METHOD(method) (method)
#endif
// Whether a lobe has a film.
#ifndef PATINA_FILM
#define PATINA_FILM(present) (present)
#endif
// One of FILM_*.
#ifndef PATINA_FILM_METHOD
#define PATINA_FILM_METHOD(method) (method)
#endif

const float PI = 3.14159265358979323846;
const float INV_PI = 0.318309886183790671538;
const float TWO_PI = 6.28318530717958647693;

// cond ? a : b with both sides evaluated; the only conditional on data that the dialect has.
float select(float a, float b, bool cond) {
    return cond ? a : b;
}
int select(int a, int b, bool cond) {
    return cond ? a : b;
}
vec2 select(vec2 a, vec2 b, bool cond) {
    return cond ? a : b;
}
vec3 select(vec3 a, vec3 b, bool cond) {
    return cond ? a : b;
}

// x to the power e. Exponent 5 is by far the commonest and costs three products instead of a pow.
float powSchlick(float x, float e) {
    float x2 = x * x;
    float general = x > 0.0 ? pow(max(x, 1e-30), e) : (e == 0.0 ? 1.0 : 0.0);
    return e == 5.0 ? x2 * x2 * x : general;
}

// Functions that the built-in ones do not match. powerOrZero: of any base, which GLSL leaves open where it is negative;
// 0 where there is no finite number. roundAway: halves away from 0. The drivers' own asin and acos are off by 3e-4.
float powerOrZero(float x, float e) {
    float p = pow(abs(x), e);
    if (x < 0.0) p = e == floor(e) ? (mod(e, 2.0) == 0.0 ? p : -p) : 0.0;
    if (e == 0.0) p = 1.0;
    return isinf(p) || isnan(p) ? 0.0 : p;
}
float roundAway(float x) {
    return sign(x) * floor(abs(x) + 0.5);
}
float arcsine(float x) {
    float s = clamp(x, -1.0, 1.0);
    return atan(s, sqrt((1.0 - s) * (1.0 + s)));
}
float arccosine(float x) {
    float c = clamp(x, -1.0, 1.0);
    return atan(sqrt((1.0 - c) * (1.0 + c)), c);
}
bool isFinite(float x) {
    return !isinf(x) && !isnan(x);
}

// One entry of the baked directional albedo tables. A host without storage buffers defines
// PATINA_ALBEDO_TABLE_FETCH and its own function of this name before this file; else the floats of
// patina::albedoTable() are bound as a storage buffer.
#ifndef PATINA_ALBEDO_TABLE_FETCH
#ifndef PATINA_ALBEDO_TABLE_BINDING
#define PATINA_ALBEDO_TABLE_BINDING 7
#endif
layout(std430, binding = PATINA_ALBEDO_TABLE_BINDING) readonly buffer PatinaAlbedoTable {
    float patinaAlbedoTable[];
};
float albedoTableFetch(int index) {
    return patinaAlbedoTable[index];
}
#endif
