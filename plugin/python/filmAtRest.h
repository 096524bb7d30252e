// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <stdexcept>

namespace patina {

/// Throws where threads of a renderer write to a film.
inline void mustRest(const Film& film) {
    if (film.isRendered())
        throw std::runtime_error("a renderer writes to the film; stop() it first");
}

} // namespace patina
