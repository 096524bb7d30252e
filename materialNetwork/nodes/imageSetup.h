// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/nodes/pattern.h"

namespace patina {

/// Opens the texture that a file input of an image node names, with the node's address modes and
/// filter. @returns a handle, or -1, after a warning, where the input "default" stands in for it
int openImage(PatternSetup& setup, const char* input);

/// openImage() of the input "file" as the first of PatternData::textures.
void prepareImage(PatternSetup& setup, PatternData& data);

} // namespace patina
