// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/emissionProfile.h"

#include <string>
#include <vector>

namespace patina {

/// The distribution of a luminaire, from an IES LM-63 file (1986 to 2019) of photometric type C.
class IesProfile : public EmissionProfile {
public:
    /// Reads a file's text.
    /// @param error receives the reason in one line when the text cannot be used
    /// @returns false then, and the profile is empty
    bool parse(const std::string& text, std::string& error);
    bool load(const std::string& file, std::string& error);

    bool empty() const { return _candela.empty(); }

    /// Candela in a direction; 0 where the table says nothing.
    /// @param theta from the lamp's axis (nadir), 0..pi
    /// @param phi about the axis, any angle, radians
    float candela(float theta, float phi) const;

    /// Mean candela over the sphere, or over the hemisphere when the table spans no more than a
    /// quarter turn: `shaping:ies:normalize` divides by it.
    /// candela() over mean().
    float factor(float theta, float phi) const override;
    float mean() const { return _mean; }
    float peak() const { return _peak; }

    /// The angle at which the table is read for a light's angle theta: `shaping:ies:angleScale`
    /// stretches the table from the axis (positive) or from the opposite pole (negative).
    static float scaledTheta(float theta, float angleScale);

private:
    bool expandHorizontal(std::string& error);
    void measure();

    std::vector<float> _vertical;   ///< degrees, ascending
    std::vector<float> _horizontal; ///< degrees, ascending, 0..360
    std::vector<float> _candela;    ///< [horizontal][vertical]
    float _mean = 0.0f, _peak = 0.0f;
};

} // namespace patina
