// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/materialProgram.h"

#include <array>

namespace patina {

/// The media that a path is in: those of the closed objects whose surfaces it has entered,
/// innermost last.
///
/// Objects may be nested. Where they overlap, the path sees the one that it entered last: an object
/// inside a liquid replaces the liquid, and behind the object the liquid counts again.
class MediumStack {
public:
    MediumStack() = default;
    MediumStack(const MediumStack& other) { *this = other; }
    MediumStack& operator=(const MediumStack& other) {
        for (int i = 0; i < other._size; ++i)
            _entries[i] = other._entries[i];
        _size = other._size;
        return *this;
    }

    /// Deeper than the stack holds, further objects are not noticed.
    void enter(const MaterialProgram* program, const Medium& medium) {
        if (_size < int(_entries.size())) _entries[_size++] = Entry(program, medium);
    }

    /// Leaves the innermost medium of this material; leaving one that was never entered (the mesh
    /// is open) changes nothing.
    void leave(const MaterialProgram* program) {
        for (int i = _size - 1; i >= 0; --i)
            if (_entries[i].program == program) {
                for (int k = i; k + 1 < _size; ++k)
                    _entries[k] = _entries[k + 1];
                --_size;
                return;
            }
    }

    /// Goes through the surface at a point, which is seen from its back side when leaving.
    void cross(const MaterialProgram& program, const ShadingPoint& point) {
        if (!program.hasInterior()) return;
        if (glm::dot(point.geometricNormal, point.viewDirection) < 0.0f)
            leave(&program);
        else
            enter(&program, program.interior(point));
    }

    bool empty() const { return _size == 0; }
    int size() const { return _size; }

    // Of the innermost medium; only when not empty().
    const Medium& medium() const { return _entries[_size - 1].medium; }
    const glm::vec3& extinction() const { return _entries[_size - 1].extinction; }
    const glm::vec3& scattering() const { return _entries[_size - 1].scattering; }

private:
    struct Entry {
        Entry() {} // NOLINT: a stack is made for every path, and few fill it
        Entry(const MaterialProgram* p, const Medium& m)
            : program(p), medium(m), extinction(m.extinction()), scattering(m.scattering()) {}

        const MaterialProgram* program;
        union {
            Medium medium;
        };
        glm::vec3 extinction, scattering;
    };
    std::array<Entry, 8> _entries;
    int _size = 0;
};

} // namespace patina
