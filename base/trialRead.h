// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Has the program patinaTryImage read an image with OpenImageIO first, where the file holds more
/// bytes than Limit::untriedBytes. Once for each state of a file. Thread safe.
/// @param isRisky has it read the headers of smaller files, too
/// @returns why it is not to be read, as in "makes OpenImageIO fail (Segmentation fault)"; empty
///          when it may be, also where OpenImageIO itself says what is wrong with it
std::string whyTrialFails(const std::string& path, bool isRisky);

} // namespace patina
