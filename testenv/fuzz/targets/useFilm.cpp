// SPDX-License-Identifier: Apache-2.0
#include "testenv/fuzz/targets/useFilm.h"

#include "hdDelegate/film/cryptomatte.h"
#include "hdDelegate/film/film.h"
#include "hdDelegate/film/imageFile.h"

#include <cstdlib>

namespace patina {

void useFilm(const Film& film) {
    if (int64_t(film.width()) * film.height() > 4096) return;
    for (const AovSpec& held : film.aovs()) {
        AovSpec spec; // another one, where names are there twice
        if (!film.findSpec(held.name, spec)) std::abort();
        const size_t channels = channelNames(spec).size();
        const size_t values = film.resolve(spec.name).size();
        if (channels != size_t(spec.components) || values % channels != 0) std::abort();
        if (spec.kind == AovKind::Coverage)
            (void)cryptomatteManifest(film.coverageNames(spec.name));
    }
    (void)film.resolve("color");
}

} // namespace patina
