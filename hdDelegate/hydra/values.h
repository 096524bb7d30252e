// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/scene/types.h"

#include <pxr/base/gf/matrix4d.h>
#include <pxr/base/vt/array.h>
#include <pxr/base/vt/value.h>
#include <pxr/imaging/hd/timeSampleArray.h>

#include <string>
#include <vector>

namespace patina {

/// Gf's matrices multiply row vectors, GLM's column vectors: same memory, same meaning.
dmat4 toMat4(const GfMatrix4d& matrix);

/// Numbers of a value or an array of any numeric type as floats.
/// @param components floats per element; 0 when the value is not numeric or empty
std::vector<float> floatsOf(const VtValue& value, int& components);

/// Points of an array of GfVec3f, GfVec3d or GfVec3h. @returns false for other types
bool pointsOf(const VtValue& value, std::vector<vec3>& points);

/// A token, string or asset path as text; empty for others. Of assets the resolved path counts.
std::string textOf(const VtValue& value);

/// A number of any type. @returns false, leaving number alone, when the value is none
bool numberOf(const VtValue& value, double& number);

template <class T> std::vector<T> toVector(const VtArray<T>& array) {
    return std::vector<T>(array.cdata(), array.cdata() + array.size());
}

/// Samples as the scene takes them: ascending times, one sample when all are equal. Times that do
/// not ascend, or are no numbers, are a host's mistake: the first sample stands for all.
/// @param mistaken receives whether there are times that descend, or are no numbers
template <class T>
Sampled<T> sampledOf(std::vector<float> times, std::vector<T> values, bool* mistaken = nullptr) {
    bool moves = false;
    for (size_t i = 1; i < values.size(); ++i)
        moves |= !(values[i] == values[0]);
    Sampled<T> result;
    if (values.empty()) return result;
    for (size_t i = 1; i < values.size(); ++i) {
        if (mistaken && moves && i < times.size()) *mistaken |= !(times[i] >= times[i - 1]);
        moves &= i < times.size() && times[i] > times[i - 1];
    }
    if (!moves) return Sampled<T>(std::move(values[0]));
    result.times = std::move(times);
    result.values = std::move(values);
    return result;
}

} // namespace patina
