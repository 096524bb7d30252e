// SPDX-License-Identifier: Apache-2.0
// C++ side of the shader dialect. Included INSIDE a namespace by shaders/shaders.h, once per scalar
// type: there `float` may be a macro for double, so this file includes nothing and has no include
// guard. Names missing here are missing from the dialect.
//
// The functions are plain (not templates) so that a float literal converts to the instance's own
// scalar, and so that they win over the templates which argument dependent lookup finds in glm.

#define PATINA_FN inline
// For what is seldom called from functions that are called often and should stay small.
#define PATINA_FN_RARE [[gnu::noinline]] inline
#define PATINA_OUT(T) T&
#define PATINA_INOUT(T) T&
// A parameter that is not read; drivers want a name where compilers warn of one.
#define PATINA_UNUSED(T, name) T

// Facts that a shader may know of all of its lobes when it is compiled, see glsl.glsl.
#define PATINA_ENERGY_KNOWN(known) (known)
#define PATINA_COMPENSATE(compensate) (compensate)
#define PATINA_ALBEDO_METHOD(method) (method)
#define PATINA_FILM(present) (present)
#define PATINA_FILM_METHOD(method) (method)

using vec2 = glm::vec<2, float, glm::defaultp>;
using vec3 = glm::vec<3, float, glm::defaultp>;
using vec4 = glm::vec<4, float, glm::defaultp>;

constexpr float PI = float(3.14159265358979323846264338327950288L);
constexpr float INV_PI = float(0.318309886183790671537767526745028724L);
constexpr float TWO_PI = float(6.28318530717958647692528676655900577L);

// cond ? a : b with both sides evaluated; the only conditional on data that the dialect has.
inline float select(float a, float b, bool cond) {
    return cond ? a : b;
}
inline int select(int a, int b, bool cond) {
    return cond ? a : b;
}
inline vec2 select(vec2 a, vec2 b, bool cond) {
    return cond ? a : b;
}
inline vec3 select(vec3 a, vec3 b, bool cond) {
    return cond ? a : b;
}

inline float sqrt(float x) {
    return std::sqrt(x);
}
inline float abs(float x) {
    return std::fabs(x);
}
inline float floor(float x) {
    return std::floor(x);
}
inline float sin(float x) {
    return std::sin(x);
}
inline float cos(float x) {
    return std::cos(x);
}
inline float exp2(float x) {
    return std::exp2(x);
}
inline float log2(float x) {
    return std::log2(x);
}
inline float pow(float x, float y) {
    return std::pow(x, y);
}
// The comparison is written so that a NaN in the first argument yields the second one.
inline float max(float a, float b) {
    return a > b ? a : b;
}
inline float min(float a, float b) {
    return a < b ? a : b;
}
inline int max(int a, int b) {
    return a > b ? a : b;
}
inline int min(int a, int b) {
    return a < b ? a : b;
}
inline float clamp(float x, float lo, float hi) {
    return min(max(x, lo), hi);
}
inline float mix(float a, float b, float t) {
    return a + (b - a) * t;
}

inline vec3 sqrt(vec3 v) {
    return vec3(sqrt(v.x), sqrt(v.y), sqrt(v.z));
}
inline vec4 sqrt(vec4 v) {
    return vec4(sqrt(v.x), sqrt(v.y), sqrt(v.z), sqrt(v.w));
}
inline vec3 abs(vec3 v) {
    return vec3(abs(v.x), abs(v.y), abs(v.z));
}
inline vec2 max(vec2 a, vec2 b) {
    return vec2(max(a.x, b.x), max(a.y, b.y));
}
inline vec2 min(vec2 a, vec2 b) {
    return vec2(min(a.x, b.x), min(a.y, b.y));
}
inline vec3 max(vec3 a, vec3 b) {
    return vec3(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z));
}
inline vec3 min(vec3 a, vec3 b) {
    return vec3(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z));
}
inline vec3 mix(vec3 a, vec3 b, vec3 t) {
    return a + (b - a) * t;
}
inline vec3 mix(vec3 a, vec3 b, float t) {
    return a + (b - a) * t;
}
inline float dot(vec2 a, vec2 b) {
    return a.x * b.x + a.y * b.y;
}
inline float dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline vec3 cross(vec3 a, vec3 b) {
    return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
inline float length(vec3 v) {
    return sqrt(dot(v, v));
}
inline vec3 normalize(vec3 v) {
    return v * (float(1) / sqrt(dot(v, v)));
}

// glm deduces one scalar type from both operands, so a float literal beside a double vector needs
// these.
inline vec2 operator*(vec2 v, float s) {
    return vec2(v.x * s, v.y * s);
}
inline vec3 operator*(vec3 v, float s) {
    return vec3(v.x * s, v.y * s, v.z * s);
}
inline vec3 operator*(float s, vec3 v) {
    return vec3(v.x * s, v.y * s, v.z * s);
}
inline vec3 operator/(vec3 v, float s) {
    return vec3(v.x / s, v.y / s, v.z / s);
}

// x to the power e. Exponent 5 is by far the commonest and costs three products instead of a pow.
inline float powSchlick(float x, float e) {
    if (e == float(5)) return (x * x) * (x * x) * x;
    return x > float(0) ? std::pow(x, e) : float(e == float(0) ? 1 : 0);
}
