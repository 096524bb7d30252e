// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pxr/usd/usd/stage.h>

PXR_NAMESPACE_USING_DIRECTIVE

namespace patina {

/// A small stage with one of everything that edits can change, in memory: /World/geometry with
/// meshes of several kinds, curves, points and shapes; /World/instancer with a nested instancer in
/// a prototype; native instances of /Library/thing; lights; materials of several models; two
/// cameras; a variant set "look" on /World/variants.
UsdStageRefPtr makeBaseStage();

} // namespace patina
