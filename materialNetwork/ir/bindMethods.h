// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/ir/materialIr.h"

namespace patina {

/// A method for every choice point that programs have: `unbound` as compileIr() makes it, with what
/// hangs on methods. Instructions that no lobe reads any more are left out.
MaterialIr bindMethods(MaterialIr unbound, const MethodSet& methods);

/// Whether a lobe on top of a layer sends light back down to the base: an interface that reflects.
bool isReturning(const LobeTemplate& lobe);

} // namespace patina
