// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/pixelFormats.h"

#include "hdDelegate/parallel.h"

#include <pxr/base/gf/half.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

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
void store(const float* values, size_t count, size_t components, void* target, const F& convert) {
    T* out = static_cast<T*>(target);
    for (size_t i = 0; i < count; ++i, values += 4)
        for (size_t c = 0; c < components; ++c)
            *out++ = convert(values[c]);
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

void writePixels(const float* values, size_t count, bool isInteger, HdFormat format, void* target) {
    const size_t n = HdGetComponentCount(format);
    const HdFormat component = HdGetComponentFormat(format);
    std::vector<float> numbers;
    if (isInteger) {
        if (component == HdFormatInt32 && n == 1) {
            char* out = static_cast<char*>(target);
            for (size_t i = 0; i < count; ++i)
                std::memcpy(out + i * sizeof(int32_t), values + 4 * i, sizeof(int32_t));
            return;
        }
        numbers.resize(4 * count);
        for (size_t i = 0; i < numbers.size(); i += 4)
            numbers[i] = float(bitsOf(values[i]));
        values = numbers.data();
    }
    switch (component) {
    case HdFormatUNorm8:
        store<uint8_t>(values, count, n, target, [](float x) {
            return uint8_t(std::lround(std::clamp(finite(x), 0.0f, 1.0f) * 255.0f));
        });
        break;
    case HdFormatSNorm8:
        store<int8_t>(values, count, n, target, [](float x) {
            return int8_t(std::lround(std::clamp(finite(x), -1.0f, 1.0f) * 127.0f));
        });
        break;
    case HdFormatFloat16:
        store<GfHalf>(values, count, n, target, [](float x) {
            return GfHalf(std::clamp(std::isnan(x) ? 0.0f : x, -65504.0f, 65504.0f));
        });
        break;
    case HdFormatFloat32: store<float>(values, count, n, target, [](float x) { return x; }); break;
    case HdFormatInt32:
        store<int32_t>(values, count, n, target,
                       [](float x) { return rounded<int32_t>(finite(x)); });
        break;
    default: break;
    }
}

void fillPixels(uint8_t* target, unsigned width, unsigned height, bool isInteger, HdFormat format,
                const std::function<void(int y, float* pixels)>& row) {
    const size_t size = HdDataSizeOfFormat(format);
    parallelFor(0u, height, [&](unsigned y) {
        std::vector<float> pixels(4 * size_t(width), 0.0f);
        for (size_t i = 3; i < pixels.size(); i += 4)
            pixels[i] = 1.0f;
        row(int(y), pixels.data());
        writePixels(pixels.data(), width, isInteger, format, target + size_t(y) * width * size);
    });
}

} // namespace patina
