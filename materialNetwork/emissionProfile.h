// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// How much of a light source's emission goes where, as measured: an IES file.
class EmissionProfile {
public:
    virtual ~EmissionProfile() = default;
    /// Relative emission; its mean over the sphere (the hemisphere for a profile of one) is 1.
    /// @param theta from the axis, 0..pi
    /// @param phi about the axis, any angle, radians
    virtual float factor(float theta, float phi) const = 0;
};

} // namespace patina
