// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace patina {

/// Whether writePixels() can fill buffers of a format: every plain format of 8, 16 and 32 bits with
/// one to four components.
bool isWritableFormat(HdFormat format);

/// Stores pixels.
/// @param values four floats of each; components that the format lacks are dropped
/// @param isInteger the first value holds the bits of an int32 (ids); such pixels keep their
///        number in integer formats and in float ones
/// UNorm8 and SNorm8 are clamped to their range and rounded; numbers that are not finite become 0.
void writePixels(const float* values, size_t count, bool isInteger, HdFormat format, void* target);

/// Fills an image, rows on all threads.
/// @param row gives the pixels of row y, four floats each; there are (0, 0, 0, 1) before
void fillPixels(uint8_t* target, unsigned width, unsigned height, bool isInteger, HdFormat format,
                const std::function<void(int y, float* pixels)>& row);

} // namespace patina
