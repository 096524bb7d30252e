// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace patina {

/// Space for one value per closure; on the stack unless the material is huge. Of each type and use
/// only one may be alive per thread.
template <class T, int use = 0> class Scratch {
public:
    explicit Scratch(size_t n) : _data(_local) {
        if (n > localCount) {
            static thread_local std::vector<T> large;
            if (large.size() < n) large.resize(n);
            _data = large.data();
        }
    }
    T& operator[](int i) { return _data[i]; }

private:
    static constexpr size_t localCount = 48;
    T _local[localCount];
    T* _data;
};

} // namespace patina
