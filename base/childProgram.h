// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace patina {

/// Programs of Patina's own that call other libraries: what those do on damaged files happens to
/// them, not to the host.

/// Where such a program is: beside the library that this is part of, in the folder of an installed
/// library, or where it was built.
std::string programPath(const std::string& name, const std::string& built);

/// Starts a program by posix_spawn, which is safe where other threads run. It inherits nothing but
/// its input and output, and ends by signals whatever the host does about them.
/// @param input a descriptor, or -1 for none
/// @throws std::runtime_error where it cannot be run
pid_t startProgram(const std::string& program, const std::vector<std::string>& arguments, int input,
                   int output);

/// Ends a program that may have ended already.
/// @returns the signal that ended it before, as in " (Segmentation fault)", or nothing
std::string endProgram(pid_t program);

} // namespace patina
