// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "testenv/hydra/host/host.h"

#include <string>
#include <utility>
#include <vector>

namespace patina {

/// The command line of hydraHost.
struct CommandLine {
    std::string stage, image; ///< no image: nothing is written
    HostOptions host;
    std::string dump, json, edits;
    std::vector<std::pair<int, int>> picks; ///< pixels to decode, from the top left
    bool pickAll = false;                   ///< decode every (prim, instance) that is seen
    int repeats = 0;                        ///< times the camera is moved and the image made again
    double limit = 600.0;                   ///< seconds
    bool help = false;
};

extern const char* const usage;

/// @throws std::runtime_error with one line about what is wrong
CommandLine parseCommandLine(const std::vector<std::string>& words);

} // namespace patina
