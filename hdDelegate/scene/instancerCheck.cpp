// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/instancerCheck.h"

#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

template <class Matrix> bool within(const Matrix& m) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(double(m[column][row])) <= largestPlace)) return false;
    return true;
}

} // namespace

bool isPlace(const MotionTransform& transform) {
    return std::all_of(transform.values.begin(), transform.values.end(), within<dmat4>);
}

namespace {

std::string problemOf(const dmat4& m) {
    if (within(m)) return {};
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!std::isfinite(m[column][row])) return "is not finite";
    return "has a value beyond 1e15, which is too large for rays";
}

} // namespace

std::string placeProblem(const MotionTransform& transform) {
    for (const dmat4& m : transform.values)
        if (std::string problem = problemOf(m); !problem.empty()) return problem;
    return {};
}

std::string inverseProblem(const dmat4& m) {
    const std::string problem = problemOf(m);
    if (!problem.empty() || hasInverse(mat4(m))) return problem;
    return "is flat or too small to have an inverse";
}

bool hasInverse(const mat4& m) {
    if (!within(m) || !within(glm::inverse(m))) return false;
    const float determinant = glm::determinant(mat3(m));
    return std::isfinite(determinant) && determinant != 0.0f;
}

bool isWideEnough(const mat4& m) {
    constexpr float maximum = 1e6f;
    const mat3 inverse(glm::inverse(m));
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row)
            if (!(std::abs(inverse[column][row]) <= maximum)) return false;
    return hasInverse(m);
}

void warnOfInstances(const Instancer& instancer, float timeCode, Diagnostics& diagnostics) {
    bool outside = false;
    std::string problem;
    for (size_t i = 0; i < instancer.transforms.size(); ++i) {
        const int prototype =
            i < instancer.prototypeIndices.size() ? instancer.prototypeIndices[i] : -1;
        outside |= prototype < 0 || size_t(prototype) >= instancer.prototypes.size();
        if (problem.empty())
            problem = inverseProblem(dmat4(transformAt(instancer.transforms[i], timeCode)));
    }
    if (outside) diagnostics.warn(instancer.path, "protoIndices", messages::prototypeOutOfRange);
    if (!problem.empty())
        diagnostics.warn(instancer.path, "transform", messages::instanceNotDrawn(problem));
}

} // namespace patina
