// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace patina {

/// Bytes as the file of an image, with the extension of the format that they begin as: OpenImageIO
/// tries that reader alone, by one thread, as trying all of them takes a hundred times as long.
/// @returns its path, which the next call replaces; empty where no format begins so
std::string imageInput(const uint8_t* data, size_t size);

} // namespace patina
