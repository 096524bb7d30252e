// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/pattern.h"

#include <string>

namespace patina {

/// Opens the texture that a file input of an image node names, with the node's address modes and
/// filter. @returns a handle, or -1, after a warning, where the input "default" stands in for it
int openImage(PatternSetup& setup, const char* input);

/// Where the image ends: outside of 0 to 1 an image node returns its default.
/// @param s, t address modes; the directions whose mode is "constant" end
/// @returns the mode that patternCover() takes; 0 for files of tiles, which have no outside
int imageEnds(PatternSetup& setup, const char* s, const char* t);

/// openImage() of the input "file" as the first of PatternData::textures.
void prepareImage(PatternSetup& setup, PatternData& data);

} // namespace patina
