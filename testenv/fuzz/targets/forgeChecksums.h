// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Makes bytes begin as a checkpoint or a part begins, and puts the right checksum wherever a
/// reader will look for one: a checksum keeps out damage, and nobody who means harm.
/// @param bytes at least 24 of them
void forgeChecksums(std::string& bytes, bool part);

} // namespace patina
