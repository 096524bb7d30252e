// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/aov.h>

#include <string>

namespace patina {

/// The film's name of an AOV as Hydra names it; empty when there is none. Hydra's `depth` is window
/// depth (the film's deviceDepth), its `cameraDepth` the distance along the camera's axis (the
/// film's depth); the other names are the same, primvars:NAME and lpe:EXPR among them, or those
/// that render vars have.
std::string filmAovOf(const TfToken& hydraName);

/// What a buffer shows of the film.
struct HdPatinaShownAov {
    std::string film;    ///< the film's name; empty: nothing
    int layer = -1;      ///< of Cryptomatte: four components from 4 * layer on; -1: all of them
    bool exact() const { ///< it is lost in pixels of fewer bits
        return layer >= 0;
    }
};

/// What a buffer of that name shows: an AOV, or a layer of Cryptomatte by its name in files
/// (crypto_object00). Nothing, with a warning, for one that no buffer holds.
HdPatinaShownAov shownAovOf(const TfToken& hydraName);

/// The buffer that a host should allocate for an AOV; of format HdFormatInvalid when it is not
/// known.
HdAovDescriptor aovDescriptor(const TfToken& hydraName);

} // namespace patina
