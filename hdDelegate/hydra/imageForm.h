// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/hydra/clearValue.h"

#include <pxr/imaging/hd/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace patina {

/// An AOV as a host's buffer holds it.
struct HdPatinaImageForm {
    std::string aov; ///< of the film; empty: not known
    int layer = -1;  ///< of HdPatinaShownAov
    HdFormat format = HdFormatInvalid;
    unsigned width = 0, height = 0;
    ClearValue clear;

    /// Makes the buffer's pixels of a film, row 0 at the bottom. Where the film is smaller,
    /// they are (0, 0, 0, 1).
    /// @param bytes whose memory is used again; empty afterwards where the film has no such AOV
    void read(const Film& film, std::vector<uint8_t>& bytes) const;

private:
    bool readFromSource(const Film& film, const AovSpec& spec, std::vector<uint8_t>& bytes) const;
    /// Whether the host's value takes the place of the AOV's own where nothing is.
    bool replaces(const AovSpec& spec) const {
        return spec.id != AovId::color && !clear.empty && clear.isInteger == spec.isInteger &&
               spec.components == 1;
    }
};

} // namespace patina
