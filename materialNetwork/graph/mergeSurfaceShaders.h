// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

namespace patina {

/// Replaces combinations of whole shaders by a single shader of each kind:
/// - A mix of surface shaders becomes one `surface` whose closures are mixed. Each part counts by
///   its share of the presence: mix * opacity of the part / opacity of the mix.
/// - A `surfacematerial` with a back shader becomes one `surface` that chooses by the visible side.
///   Without a back shader, or with one that has no closure, both sides show the front. With only a
///   back shader the front side is absent (MaterialX leaves that open).
/// - `surface_unlit` becomes a `surface` that emits and lets light pass straight through.
/// - A `surface` whose thin_walled varies, and a mix of thin slabs with solid surfaces, become
///   mixes in which the thin closures are inside of a `patina_thin_slab`.
/// - Mixes of displacement and volume shaders become mixes of their displacements and volumes.
/// - A material on the surface terminal gives its displacement and volume to terminals that are not
///   set.
///
/// @param graph simplified
/// @returns true if something was replaced, so that simplifying again may help
bool mergeSurfaceShaders(Graph& graph, Diagnostics& diagnostics);

} // namespace patina
