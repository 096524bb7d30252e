// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/cpu/materialProgram.h"

#include <array>

namespace patina {

/// The media that a path is in: those of the closed objects whose surfaces it has entered.
///
/// Objects may be nested. Where they overlap, the path sees the one of the highest priority, and of
/// these the one that it entered last: an object inside a liquid replaces the liquid, and behind
/// the object the liquid counts again. Surfaces of an object with a priority are not there where
/// one of a higher priority is around (Schmidt and Budge 2002, Simple Nested Dielectrics in Ray
/// Traced Images).
class MediumStack {
public:
    MediumStack() = default;
    MediumStack(const MediumStack& other) { *this = other; }
    MediumStack& operator=(const MediumStack& other) {
        for (int i = 0; i < other._size; ++i)
            _entries[i] = other._entries[i];
        _size = other._size;
        _top = other._top;
        return *this;
    }

    /// Deeper than the stack holds, further objects are not noticed.
    /// @param priority of the prim; 0: none
    /// @param ior where there is a priority
    void enter(const MaterialProgram* program, const Medium& medium, int priority = 0,
               float ior = 1.0f) {
        if (_size == int(_entries.size())) return;
        _entries[_size++] = Entry(program, medium, priority, ior);
        if (_size == 1 || priority >= _entries[_top].priority) _top = _size - 1;
    }

    /// Leaves the innermost medium of this material; leaving one that was never entered (the mesh
    /// is open) changes nothing.
    void leave(const MaterialProgram* program, int priority = 0) {
        const int own = find(program, priority);
        if (own < 0) return;
        for (int k = own; k + 1 < _size; ++k)
            _entries[k] = _entries[k + 1];
        --_size;
        _top = topWithout(-1);
    }

    /// Goes through the surface at a point, which is seen from its back side when leaving.
    void cross(const MaterialProgram& program, const ShadingPoint& point, int priority = 0,
               float ior = 1.0f) {
        if (!(priority > 0 ? program.encloses() : program.hasInterior())) return;
        if (leaves(point))
            leave(&program, priority);
        else
            enter(&program, program.interior(point), priority, ior);
    }

    bool empty() const { return _size == 0; }
    int size() const { return _size; }

    /// Whether priorities decide where the path is.
    bool ranked() const { return _size > 0 && _entries[_top].priority > 0; }
    /// Whether the surface of a prim with a priority is not there, as a higher one is around.
    bool hides(const MaterialProgram& program, const ShadingPoint& point, int priority) const {
        const int other = topBeside(program, point, priority);
        return other >= 0 && _entries[other].priority > priority;
    }
    /// The ior of what a surface borders on. What has no priority has none either.
    float iorAround(const MaterialProgram& program, const ShadingPoint& point, int priority) const {
        const int other = topBeside(program, point, priority);
        return other >= 0 ? _entries[other].ior : 1.0f;
    }

    // Of the medium that the path sees; only when not empty().
    const Medium& medium() const { return _entries[_top].medium; }
    const glm::vec3& extinction() const { return _entries[_top].extinction; }
    const glm::vec3& scattering() const { return _entries[_top].scattering; }

private:
    static bool leaves(const ShadingPoint& point) {
        return glm::dot(point.geometricNormal, point.viewDirection) < 0.0f;
    }
    int find(const MaterialProgram* program, int priority) const {
        for (int i = _size - 1; i >= 0; --i)
            if (_entries[i].program == program && _entries[i].priority == priority) return i;
        return -1;
    }
    /// Place of the medium that counts, were one of them not there; -1 where none is left.
    int topWithout(int left) const {
        int top = -1;
        for (int i = 0; i < _size; ++i)
            if (i != left && (top < 0 || _entries[i].priority >= _entries[top].priority)) top = i;
        return top;
    }
    /// The one that counts beside the object whose surface this is.
    int topBeside(const MaterialProgram& program, const ShadingPoint& point, int priority) const {
        return topWithout(leaves(point) ? find(&program, priority) : -1);
    }

    struct Entry {
        Entry() {} // NOLINT: a stack is made for every path, and few fill it
        Entry(const MaterialProgram* p, const Medium& m, int rank, float n)
            : program(p), medium(m), extinction(m.extinction()), scattering(m.scattering()),
              priority(rank), ior(n) {}

        const MaterialProgram* program;
        union {
            Medium medium;
        };
        glm::vec3 extinction, scattering;
        int priority;
        float ior;
    };
    std::array<Entry, 8> _entries;
    int _size = 0, _top = -1;
};

} // namespace patina
