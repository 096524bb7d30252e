// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/delegateState.h"

#include <pxr/imaging/hd/command.h>

namespace patina {

/// Commands that hosts can give the delegate by name.
HdCommandDescriptors commandDescriptors();

/// @returns false, with a warning, for unknown commands, wrong arguments and failures
bool invokeCommand(HdPatinaDelegateState& state, const TfToken& command, const HdCommandArgs& args);

} // namespace patina
