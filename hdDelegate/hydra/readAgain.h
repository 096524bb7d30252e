// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderParam.h"

#include <pxr/imaging/hd/renderIndex.h>

namespace patina {

/// Reads once what syncs have found out to be stale, but hosts do not mark dirty: the links of
/// prims after those of a light have changed, what was sampled before a camera opened a longer
/// shutter, lights whose filters, volumes whose fields and prims whose coordinate
/// systems changed. However many lights or cameras
/// changed, each prim is asked once. Host's thread, while nothing syncs.
void readAgain(HdRenderIndex& index, HdPatinaRenderParam& param);

} // namespace patina
