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
    float real(float least, float most) {
        return least + (most - least) * (float(_engine() >> 8) / 16777216.0f);
    }
    bool chance(float probability) { return real(0.0f, 1.0f) < probability; }
    PXR_NS::GfVec3f vec3(float least, float most) {
        const float x = real(least, most), y = real(least, most);
        return PXR_NS::GfVec3f(x, y, real(least, most));
    }
    template <class List> const typename List::value_type& pick(const List& list) {
        return list[size_t(index(list.size()))];
    }

private:
    std::mt19937 _engine;
};

} // namespace patina
