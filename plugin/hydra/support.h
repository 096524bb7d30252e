// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Whether this machine can run the renderer. Cheap: hosts ask often.
/// @param reason set to one line when it cannot; may be null
bool isSupported(std::string* reason);

} // namespace patina
