// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/settings.h"

namespace patina {

/// Whether the settings' renderTags, rootPaths and excludePaths let a prim be drawn. An empty
/// render tag counts as "geometry". Paths are compared with the prim's own path, inside prototypes
/// too; "/a" holds "/a" and "/a/b" but not "/ab".
bool isDrawn(const Geometry& prim, const RenderSettings& settings);

/// Whether an instancer may draw anything: some ray sees it and no excludePaths holds it. Tags and
/// rootPaths choose among geometry, so those of its prototypes decide.
bool isDrawn(const Instancer& prim, const RenderSettings& settings);

} // namespace patina
