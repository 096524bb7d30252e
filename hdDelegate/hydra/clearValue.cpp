// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/clearValue.h"

#include <pxr/base/gf/half.h>
#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec2i.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec3i.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/base/gf/vec4i.h>

#include <cstdint>
#include <cstring>

namespace patina {

namespace {

template <class Vector> bool readVector(const VtValue& value, ClearValue& clear) {
    // Vt converts doubles, halfs and ints to the float vector of the same length.
    const VtValue converted = VtValue::Cast<Vector>(value);
    if (converted.IsEmpty()) return false;
    const Vector& vector = converted.UncheckedGet<Vector>();
    for (size_t i = 0; i < Vector::dimension; ++i)
        clear.values[i] = vector[i];
    clear.empty = false;
    return true;
}

} // namespace

ClearValue clearValueOf(const VtValue& value) {
    ClearValue clear;
    if (value.IsEmpty()) return clear;
    if (value.IsHolding<int>() || value.IsHolding<unsigned>() || value.IsHolding<int64_t>()) {
        const int32_t number = VtValue::Cast<int>(value).GetWithDefault<int>(-1);
        std::memcpy(&clear.values[0], &number, sizeof number);
        clear.isInteger = true;
        clear.empty = false;
        return clear;
    }
    if (value.CanCast<float>()) {
        const VtValue number = VtValue::Cast<float>(value);
        if (number.IsHolding<float>()) {
            clear.values[0] = number.UncheckedGet<float>();
            clear.empty = false;
            return clear;
        }
    }
    if (readVector<GfVec4f>(value, clear) || readVector<GfVec3f>(value, clear) ||
        readVector<GfVec2f>(value, clear))
        return clear;
    return clear;
}

} // namespace patina
