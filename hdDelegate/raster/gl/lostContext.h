// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// From the N-th call on the functions of `gl` do nothing, as if the driver had lost the context:
/// for tests. Of all contexts, for they share their objects. Called once the functions are loaded.
void loseContextAtCall(long number);

} // namespace patina
