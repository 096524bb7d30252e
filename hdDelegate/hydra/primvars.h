// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/hydra/renderParam.h"
#include "hdDelegate/scene/geometry.h"

#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

/// The values of a prim's dirty primvars.
struct PrimvarUpdate {
    bool pointsListed = false; ///< the prim has points, dirty or not
    bool pointsChanged = false;
    Sampled<std::vector<vec3>> points;
};

/// Adds a primvar, sorted by name, in place of the one of that name.
void replacePrimvar(Geometry& prim, Primvar primvar);

/// Whether particles keep a primvar in arrays of their own, see Splats.
bool isSplatPrimvar(const std::string& name);

/// Warns of a primvar that is left out because its type holds no numbers; not of texts, which marks
/// and names are, nor of values that are empty.
void warnOfType(HdPatinaRenderParam& param, const SdfPath& id, const std::string& primvar,
                const VtValue& value);

/// Converts a primvar whose colour space the host tells into the rendering space; warns of a space
/// that is unknown.
void toRenderingSpace(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
                      const HdPrimvarDescriptor& descriptor, Primvar& primvar);

/// Brings the primvars of a scene prim up to date: removes those that Hydra no longer lists, and
/// fetches the dirty ones, authored or computed (skinning), indexed or not. They are kept sorted by
/// name. `points` come with their motion samples, including those from velocities. Primvars that
/// drive skinning, texts and empty arrays are left out.
/// @param all fetch everything, dirty or not
PrimvarUpdate updatePrimvars(HdSceneDelegate& delegate, HdPatinaRenderParam& param,
                             const SdfPath& id, HdDirtyBits dirtyBits, bool all, Geometry& prim);

} // namespace patina
