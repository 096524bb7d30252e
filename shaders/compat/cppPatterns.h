// SPDX-License-Identifier: Apache-2.0
// Names of the dialect that patterns alone need, as C++. Included INSIDE a namespace by
// shaders/patterns.h after shaders/compat/cpp.h, in floats alone. Names missing in both files are
// missing from the dialect.

using uint = unsigned int;
using mat3 = glm::mat3;
using mat4 = glm::mat4;
using glm::determinant;
using glm::inverse;
using glm::transpose;

inline float exp(float x) {
    return std::exp(x);
}
inline float log(float x) {
    return std::log(x);
}
inline float tan(float x) {
    return std::tan(x);
}
inline float atan(float y, float x) {
    return std::atan2(y, x);
}
inline float ceil(float x) {
    return std::ceil(x);
}

// Functions that GLSL has otherwise, or not well enough; see glsl.glsl.
inline float powerOrZero(float x, float e) {
    const float p = std::pow(x, e);
    return std::isfinite(p) ? p : 0.0f;
}
inline float roundAway(float x) {
    return std::round(x);
}
inline float arcsine(float x) {
    return std::asin(clamp(x, -1.0f, 1.0f));
}
inline float arccosine(float x) {
    return std::acos(clamp(x, -1.0f, 1.0f));
}
inline bool isFinite(float x) {
    return std::isfinite(x);
}

inline vec4 floor(vec4 v) {
    return vec4(floor(v.x), floor(v.y), floor(v.z), floor(v.w));
}
inline vec4 ceil(vec4 v) {
    return vec4(ceil(v.x), ceil(v.y), ceil(v.z), ceil(v.w));
}
inline vec4 abs(vec4 v) {
    return vec4(abs(v.x), abs(v.y), abs(v.z), abs(v.w));
}
inline vec4 exp(vec4 v) {
    return vec4(exp(v.x), exp(v.y), exp(v.z), exp(v.w));
}
inline vec4 log(vec4 v) {
    return vec4(log(v.x), log(v.y), log(v.z), log(v.w));
}
inline vec4 sin(vec4 v) {
    return vec4(sin(v.x), sin(v.y), sin(v.z), sin(v.w));
}
inline vec4 cos(vec4 v) {
    return vec4(cos(v.x), cos(v.y), cos(v.z), cos(v.w));
}
inline vec4 tan(vec4 v) {
    return vec4(tan(v.x), tan(v.y), tan(v.z), tan(v.w));
}
inline vec4 min(vec4 a, vec4 b) {
    return vec4(min(a.x, b.x), min(a.y, b.y), min(a.z, b.z), min(a.w, b.w));
}
inline vec4 max(vec4 a, vec4 b) {
    return vec4(max(a.x, b.x), max(a.y, b.y), max(a.z, b.z), max(a.w, b.w));
}
