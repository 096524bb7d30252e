// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/edits/edits.h"

#include <string>
#include <vector>

namespace patina {

/// What a user does in a viewport beyond edits() of single values: drags and plays, imports and
/// deletes, swaps textures, drags the window's corner. All go to the session layer.
const std::vector<Edit>& viewportEdits();

/// Every kind of edit that comes back: those of edits.h without the ones that OpenUSD itself does
/// not survive or undo, and viewportEdits().
std::vector<Edit> sessionEdits();

/// Writes the images that viewportEdits() puts into materials and lights. To be called once.
/// @throws std::runtime_error naming the file
void writeTextures(const std::string& folder);

/// Takes back all edits of the session layer, and what the host was told meanwhile.
/// @param start the options that the host was made with
void startOver(const UsdStageRefPtr& stage, Host& host, const HostOptions& start);

} // namespace patina
