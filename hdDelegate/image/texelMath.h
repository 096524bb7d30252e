// SPDX-License-Identifier: Apache-2.0
// One stored channel and its linear value. Included where texels are filtered or averaged.
#pragma once

#include <OpenImageIO/half.h>

#include <algorithm>
#include <array>
#include <cstdint>

namespace patina {

/// Finds the 8-bit code whose linear value is nearest.
class TexelEncoder {
public:
    explicit TexelEncoder(const std::array<float, 256>& decode) : _decode(decode) {
        int code = 0;
        for (int i = 0; i < cells; ++i) {
            while (code < 255 && middle(code) <= float(i) / cells)
                ++code;
            _guess[size_t(i)] = uint8_t(code);
        }
    }
    uint8_t operator()(float linear) const {
        int cell = int(std::min(std::max(linear, 0.0f), 1.0f) * cells);
        int code = _guess[size_t(std::min(cell, cells - 1))];
        while (code < 255 && middle(code) <= linear)
            ++code;
        return uint8_t(code);
    }

private:
    static constexpr int cells = 4096;
    float middle(int code) const {
        return 0.5f * (_decode[size_t(code)] + _decode[size_t(code) + 1]);
    }
    std::array<float, 256> _decode;
    std::array<uint8_t, cells> _guess;
};

inline float linearOf(uint8_t v, const float* table) {
    return table[v];
}
inline float linearOf(uint16_t v, const float*) {
    return v * (1.0f / 65535.0f);
}
inline float linearOf(half v, const float*) {
    return float(v);
}
inline float linearOf(float v, const float*) {
    return v;
}

inline void storeLinear(float v, const TexelEncoder* encode, uint8_t& to) {
    to = (*encode)(v);
}
inline void storeLinear(float v, const TexelEncoder*, uint16_t& to) {
    to = uint16_t(std::min(std::max(v, 0.0f), 1.0f) * 65535.0f + 0.5f);
}
inline void storeLinear(float v, const TexelEncoder*, half& to) {
    to = half(v);
}
inline void storeLinear(float v, const TexelEncoder*, float& to) {
    to = v;
}

} // namespace patina
