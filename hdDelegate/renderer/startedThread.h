// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>

namespace patina {

/// A thread that runs a function. Throws std::runtime_error where the system has no thread to give.
template <class Function> std::thread startedThread(Function&& function) {
    try {
        return std::thread(std::forward<Function>(function));
    } catch (const std::system_error& error) {
        throw std::runtime_error(std::string("no thread can be started to render: ") +
                                 error.what());
    }
}

} // namespace patina
