// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// OpenEXR makes room for attributes, tiles and rows as a header claims them, before it reads them:
/// files of a hundred bytes took gigabytes.
/// @param file descriptor of a regular file
/// @returns whether it begins as an OpenEXR that claims more than a file of its size may hold
bool exrClaimsMore(int file);

} // namespace patina
