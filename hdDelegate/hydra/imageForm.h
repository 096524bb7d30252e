// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/film/filmSource.h"
#include "hdDelegate/hydra/clearValue.h"

#include <pxr/imaging/hd/types.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace patina {

/// Finished pixels for a host's buffer: in memory, or on the host's device.
struct HdPatinaPixels {
    std::vector<uint8_t> bytes;
    std::shared_ptr<DeviceImage> device;
    bool isDepth = false; ///< in a texture of depths

    bool empty() const { return bytes.empty() && !device; }
};

/// An AOV as a host's buffer holds it.
struct HdPatinaImageForm {
    std::string aov; ///< of the film; empty: not known
    int layer = -1;  ///< of HdPatinaShownAov
    HdFormat format = HdFormatInvalid;
    unsigned width = 0, height = 0;
    ClearValue clear;
    bool onDevice = false; ///< of the host, where the film's source can draw it there

    /// Makes the buffer's pixels of a film, row 0 at the bottom. Where the film is smaller,
    /// they are (0, 0, 0, 1).
    /// @param pixels whose memory is used again; empty afterwards where the film has no such AOV
    void read(const Film& film, HdPatinaPixels& pixels) const;

private:
    bool readFromSource(const Film& film, const AovSpec& spec, HdPatinaPixels& pixels) const;
    /// Whether the host's value takes the place of the AOV's own where nothing is.
    bool replaces(const AovSpec& spec) const {
        return spec.id != AovId::color && !clear.empty && clear.isInteger == spec.isInteger &&
               spec.components == 1;
    }
};

} // namespace patina
