// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "base/diagnostics.h"

#include <string>

namespace patina {

/// Numbers of transforms, and of their inverses, up to which rays can follow them: those that rays
/// are made of end at 1e18.
inline constexpr double largestPlace = 1e15;

/// Whether something may stand under a transform: all of it is finite and within largestPlace.
bool isPlace(const MotionTransform& transform);
/// The error of a transform that is no place, as a message goes on after its name; else
/// empty.
std::string placeProblem(const MotionTransform& transform);
/// The same of one that something is to be drawn or seen under, see hasInverse().
std::string inverseProblem(const dmat4& m);
/// Whether something can be drawn under a transform: its inverse is a place too.
bool hasInverse(const mat4& m);

/// Whether rays that go into the space of a transform stay so small that none has to be checked.
bool isWideEnough(const mat4& m);

/// Warns of instances whose prototype does not exist, or whose transform at a time has no inverse.
void warnOfInstances(const Instancer& instancer, float timeCode, Diagnostics& diagnostics);

} // namespace patina
