// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace patina {

/// The device or its driver cannot do it, while another back end may.
struct DeviceError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// What all else that fails then comes from.
/// @throws DeviceError where the driver has lost the context that is current
void throwIfLost();

/// The log of a driver as one line of at most 300 characters.
std::string oneLine(const std::string& log);

} // namespace patina
