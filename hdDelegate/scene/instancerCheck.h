#pragma once

#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/diagnostics.h"

namespace patina {

/// Whether something can be drawn under a transform.
bool hasInverse(const mat4& m);

/// Warns of primvars with a value per instance, which no renderer draws.
void warnOfInstancePrimvars(const Instancer& instancer, Diagnostics& diagnostics);
/// Warns of instances whose prototype does not exist, or whose transform at a time has no inverse.
void warnOfInstances(const Instancer& instancer, float timeCode, Diagnostics& diagnostics);

} // namespace patina
