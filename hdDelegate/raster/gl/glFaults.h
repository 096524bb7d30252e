// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace patina {

/// Faults that a test asks the driver for. The environment variable PATINA_GL_FAULT holds some of
/// them, separated by commas:
/// - `lost:N`        the context is lost once N passes are drawn (0: before the first)
/// - `lostAtCall:N` the context is lost at the N-th call of OpenGL; read when the first one is made
/// - `memory:N`      the driver is out of memory once N passes are drawn
/// - `program:NAME`  a program whose first stage has that name does not compile (background,
///   shadow)
/// - `material:PATH` the program of that material does not compile
/// - `compiling:N`   programs of a material take N milliseconds more
/// - `singleDraws:1` shaders are not told which draw of a call they run for
/// - `ownPages:1`    each range of buffers has a page of its own
/// - `sharing:1`     a host's context shares no objects
/// - `storageBlocks:N` shaders may read N buffers
/// - `uniformBlock:N` uniform blocks hold N bytes
/// - `textureSize:N` textures of materials may have N x N pixels
/// @returns the text behind the colon; empty without such a fault
std::string glFault(const std::string& kind);

} // namespace patina
