// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace patina {

using glm::dmat4;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;
using glm::mat3;
using glm::mat4;
using glm::uvec2;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

/// A value sampled over time. Times are time codes relative to the frame that is rendered and
/// ascend; a single sample means that the value does not move.
template <class T> struct Sampled {
    std::vector<float> times;
    std::vector<T> values;

    Sampled() = default;
    Sampled(T value) : times{0.0f}, values{std::move(value)} {}
    bool empty() const { return values.empty(); }
    bool moves() const { return values.size() > 1; }
    const T& first() const { return values.front(); }
};

enum class Interpolation { Constant, Uniform, Varying, Vertex, FaceVarying };

/// A primvar as authored. Numbers are floats whatever the authored type.
struct Primvar {
    std::string name;
    Interpolation interpolation = Interpolation::Constant;
    int components = 1;        ///< floats per element, 1..16
    std::vector<float> values; ///< components * number of elements
    std::vector<int> indices;  ///< into elements; empty when not indexed
};

/// Transforms are column vectors as in GLM: world = transform * local. The local frame is scene
/// units; a motion transform is interpolated linearly, element by element, between its samples.
/// They are kept in double, so that a renderer can look at what is far away from near by: see
/// seenFrom().
struct MotionTransform : Sampled<dmat4> {
    MotionTransform() = default;
    MotionTransform(const dmat4& value) : Sampled<dmat4>(value) {}
    MotionTransform(const mat4& value) : Sampled<dmat4>(dmat4(value)) {}
    MotionTransform(Sampled<dmat4> samples) : Sampled<dmat4>(std::move(samples)) {}
};

/// A transform into the world, as one into a space whose origin is that place in the world. From
/// the world's own origin nothing changes.
inline mat4 seenFrom(const dvec3& origin, dmat4 toWorld) {
    toWorld[3] -= glm::dvec4(origin, 0.0);
    return mat4(toWorld);
}

} // namespace patina
