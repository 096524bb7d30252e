// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

/// Gives all targets the same lower limits: an input takes milliseconds and little memory, and
/// small inputs meet the limits.
void limitInputs();

} // namespace patina
