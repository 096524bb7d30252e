// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/pixelFormats.h"

#include <pxr/base/gf/half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace patina {

namespace {

float finite(float x) {
    return std::isfinite(x) ? x : 0.0f;
}

template <class T> T rounded(double x) {
    const double low = std::numeric_limits<T>::lowest(), high = std::numeric_limits<T>::max();
    return T(std::lround(std::clamp(x, low, high)));
}

template <class T, class F>
void store(const float* values, size_t components, void* target, const F& convert) {
    T* out = static_cast<T*>(target);
    for (size_t i = 0; i < components; ++i)
        out[i] = convert(values[i]);
}

int32_t bitsOf(float value) {
    int32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

} // namespace

bool isWritableFormat(HdFormat format) {
    switch (HdGetComponentFormat(format)) {
    case HdFormatUNorm8:
    case HdFormatSNorm8:
    case HdFormatFloat16:
    case HdFormatFloat32:
    case HdFormatInt32: return true;
    default: return false; // Hydra gives 16-bit integers no size
    }
}

void writePixel(const float source[4], bool isInteger, HdFormat format, void* target) {
    const size_t n = HdGetComponentCount(format);
    const HdFormat component = HdGetComponentFormat(format);
    float values[4] = {source[0], source[1], source[2], source[3]};
    if (isInteger) {
        if (component == HdFormatInt32 && n == 1) {
            std::memcpy(target, source, sizeof(int32_t));
            return;
        }
        values[0] = float(bitsOf(source[0]));
        values[1] = values[2] = values[3] = 0.0f;
    }
    switch (component) {
    case HdFormatUNorm8:
        store<uint8_t>(values, n, target, [](float x) {
            return uint8_t(std::lround(std::clamp(finite(x), 0.0f, 1.0f) * 255.0f));
        });
        break;
    case HdFormatSNorm8:
        store<int8_t>(values, n, target, [](float x) {
            return int8_t(std::lround(std::clamp(finite(x), -1.0f, 1.0f) * 127.0f));
        });
        break;
    case HdFormatFloat16:
        store<GfHalf>(values, n, target, [](float x) {
            return GfHalf(std::clamp(std::isnan(x) ? 0.0f : x, -65504.0f, 65504.0f));
        });
        break;
    case HdFormatFloat32: std::memcpy(target, values, n * sizeof(float)); break;
    case HdFormatInt32:
        store<int32_t>(values, n, target, [](float x) { return rounded<int32_t>(finite(x)); });
        break;
    default: break;
    }
}

} // namespace patina
