// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/imaging/hd/sceneDelegate.h>

namespace patina {

PXR_NAMESPACE_USING_DIRECTIVE

/// \return path of the material that a prim or a geometry subset is bound to for final renders
/// (purpose "full", else all purposes); `fallback` where the scene says nothing of either.
/// Scene indices know every purpose, but the adapter that answers HdSceneDelegate's questions asks
/// them in some releases for all purposes only.
SdfPath materialOf(HdSceneDelegate& delegate, const SdfPath& prim, const SdfPath& fallback);

} // namespace patina
