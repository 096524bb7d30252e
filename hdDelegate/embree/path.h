#pragma once

#include "hdDelegate/embree/embreeScene.h"
#include "hdDelegate/embree/sampler.h"

#include <array>

namespace patina {

/// The absorbing insides of closed objects that a path is in, innermost last.
class MediumStack {
public:
    void enter(const MaterialProgram* program, const vec3& absorption) {
        if (_size < int(_entries.size())) _entries[_size++] = {program, absorption};
    }
    /// Leaves the innermost medium of this material; leaving one that was never entered (the
    /// camera stands inside, or the mesh is open) changes nothing.
    void leave(const MaterialProgram* program) {
        for (int i = _size - 1; i >= 0; --i)
            if (_entries[i].program == program) {
                for (int k = i; k + 1 < _size; ++k)
                    _entries[k] = _entries[k + 1];
                --_size;
                return;
            }
    }
    /// Absorption coefficient per scene unit.
    vec3 absorption() const { return _size ? _entries[_size - 1].absorption : vec3(0.0f); }
    bool empty() const { return _size == 0; }

private:
    struct Entry {
        const MaterialProgram* program = nullptr;
        vec3 absorption{0.0f};
    };
    std::array<Entry, 8> _entries;
    int _size = 0;
};

/// A path while it is traced: the ray that goes on, and what multiple importance sampling has to
/// know about the vertex it comes from.
struct Path {
    explicit Path(Sampler& s) : sampler(s) {}

    Sampler& sampler;
    vec3 origin{0.0f}, direction{0.0f};
    float near = 0.0f, far = 0.0f, time = 0.0f;
    vec3 throughput{1.0f}, radiance{0.0f};
    float alpha = 0.0f;
    float coneWidth = 0.0f, coneSpread = 0.0f;
    int depth = 0; ///< bounces so far; 0 is the camera's own ray

    // the last vertex that scattered
    bool specular = true; ///< no light sample could have found this ray
    float pdf = 0.0f;
    vec3 vertex{0.0f}, vertexNormal{0.0f};
    bool vertexTwoSided = false;
    vec3 diffuseShare{1.0f}, specularShare{0.0f}; ///< of the throughput's last factor, sum 1
    const Surface* vertexSurface = nullptr;       ///< for light linking
    const std::vector<int>* vertexInstanceCategories = nullptr;

    MediumStack media;

    bool fromCamera() const { return depth == 0; }
};

} // namespace patina
