// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/geometry/curveForms.h"
#include "hdDelegate/geometry/tetSurface.h"
#include "hdDelegate/hydra/compat.h"

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// The beginning of names of primvars that the plugin's scene index makes of attributes for which
/// Hydra's own prims have no place. They are no primvars of the prim.
inline constexpr const char* sourcePrefix = "patina:source:";

/// The type of Hermite curves before the plugin's scene index makes NURBS curves of them.
inline constexpr const char* hermitePrimType = "patinaHermiteCurves";

/// An attribute of the stage's prim, as it was handed on or as the delegate gives it.
VtValue sourceOf(HdSceneDelegate& delegate, const SdfPath& id, const std::string& name);

/// The type of the stage's prim before UsdImaging made a mesh or linear curves of its points: the
/// plugin's scene index hands its attributes on, UsdImagingDelegate gives any attribute by name.
///
/// @returns false where it was no NURBS patch; else the mesh is one
bool readPatch(HdSceneDelegate& delegate, const SdfPath& id, Mesh& mesh);

/// @returns false where it was no mesh of tetrahedra
bool readTets(HdSceneDelegate& delegate, const SdfPath& id, std::vector<int>& tets,
              std::vector<int>& surface);

/// @param curves with points, counts and primvars
/// @returns Bezier curves, nothing where they were neither NURBS nor Hermite curves
std::shared_ptr<const Curves> bezierOf(HdSceneDelegate& delegate, const SdfPath& id,
                                       const Curves& curves, Diagnostics& diagnostics);

} // namespace patina
