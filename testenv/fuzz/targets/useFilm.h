// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace patina {

class Film;

/// Resolves what a film holds, where it is small. Aborts where an AOV has other values than
/// channels.
void useFilm(const Film& film);

} // namespace patina
