// SPDX-License-Identifier: Apache-2.0
#pragma once

// Every lobe of the dialect once more in float (patina::shLoosest), as a driver may compute it:
// functions are off by what GLSL allows (GLSL 4.50, 4.7.1), products are fused with sums, and
// quotients are products. GLSL says nothing of sine and cosine; theirs are those of graphics
// processors, 2^-21 (NVIDIA, CUDA C++ Programming Guide, intrinsic functions).

#include "shaders/shaders.h"

namespace patina {

namespace shLoosest {
// What cpp.h finds in std.
namespace std {
using ::std::fabs;
using ::std::floor;

/// A number between -1 and 1 that hangs on another.
inline float anywhere(float x) {
    unsigned bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    bits = (bits ^ (bits >> 16)) * 0x7feb352du;
    bits = (bits ^ (bits >> 15)) * 0x846ca68bu;
    return float(int(bits ^ (bits >> 16))) * 0x1p-31f;
}
/// A result that is wrong by up to so many units in the last place.
inline float off(float x, float units) {
    return x + x * (anywhere(x) * units * 0x1p-23f);
}
inline float offBy(float x, float most) {
    return x + anywhere(x) * most;
}
inline float sqrt(float x) {
    return off(::std::sqrt(x), 4.5f); // 1 / inversesqrt(x)
}
inline float exp2(float x) {
    return off(::std::exp2(x), 3.0f + 2.0f * fabs(x));
}
inline float log2(float x) {
    const float exact = ::std::log2(x);
    return x < 0.5f || x > 2.0f ? off(exact, 3.0f) : offBy(exact, 0x1p-21f);
}
inline float sin(float x) {
    return offBy(::std::sin(x), 0x1p-21f);
}
inline float cos(float x) {
    return offBy(::std::cos(x), 0x1p-21f);
}
inline float pow(float x, float y) {
    return exp2(y * log2(x));
}
} // namespace std
#include "shaders/compat/cpp.h"
inline float albedoTableFetch(int index) {
    return float(patinaAlbedoTable[index]);
}
#include "shaders/lobes.glsl"
} // namespace shLoosest

#include "shaders/compat/cppEnd.h"

} // namespace patina
