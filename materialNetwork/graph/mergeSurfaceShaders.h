// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "materialNetwork/graph/graph.h"

namespace patina {

/// Replaces what is made of whole shaders by a single shader of each kind:
/// - a mix of surface shaders becomes one `surface` whose closures are mixed. Each part counts by
///   its share of what is there: mix * opacity of the part / opacity of the mix;
/// - a `surfacematerial` with a back shader becomes one `surface` that chooses by the side that is
///   seen. Without a back shader, or with one that has no closure, both sides show the front; with
///   a back shader alone the front side is not there (MaterialX leaves that open);
/// - `surface_unlit` becomes a `surface` that emits, and passes light straight on;
/// - a `surface` whose thin_walled varies, and mixes of thin slabs with solid surfaces, become
///   mixes in which the thin closures stand in a `patina_thin_slab`;
/// - mixes of displacement and volume shaders become mixes of what they displace and hold;
/// - a material on the surface terminal gives its displacement and volume to terminals not set.
///
/// @param graph simplified
/// @returns true when something was replaced, so that it pays to simplify again
bool mergeSurfaceShaders(Graph& graph, Diagnostics& diagnostics);

} // namespace patina
