// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/base/gf/vec3f.h>

#include <cstdint>
#include <random>

namespace patina {

/// Numbers that are the same everywhere: the standard's distributions differ between libraries.
class Random {
public:
    explicit Random(uint32_t seed) : _engine(seed) {}

    /// @returns 0 to count - 1
    int index(size_t count) { return int(_engine() % uint32_t(count)); }
    float real(float minimum, float maximum) {
        return minimum + (maximum - minimum) * (float(_engine() >> 8) / 16777216.0f);
    }
    bool chance(float probability) { return real(0.0f, 1.0f) < probability; }
    PXR_NS::GfVec3f vec3(float minimum, float maximum) {
        const float x = real(minimum, maximum), y = real(minimum, maximum);
        return PXR_NS::GfVec3f(x, y, real(minimum, maximum));
    }
    template <class List> const typename List::value_type& pick(const List& list) {
        return list[size_t(index(list.size()))];
    }

private:
    std::mt19937 _engine;
};

} // namespace patina
