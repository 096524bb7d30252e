// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/delegateState.h"

#include <pxr/base/vt/dictionary.h>

namespace patina {

/// Statistics that hosts show while a render runs, under the names that they look for: percentDone
/// (0..100), fractionDone, numCompletedSamples, totalClockTime and timeRemaining (seconds),
/// renderProgressAnnotation (a line), peakMemory (bytes of the process), warnings; everything in
/// RenderProgress::statistics as patina:NAME; and patina:imagesShown, how often the host's buffers
/// have been given an image since the last edit, patina:imagesOnDevice, how many of these came
/// without a way through memory, and patina:imagesByMemory, why none can; and where an image with
/// layers of Cryptomatte is done, their metadata and manifests as in files, cryptomatte/ID/name....
/// Of several passes the one that is furthest behind counts.
VtDictionary renderStats(const HdPatinaDelegateState& state);

} // namespace patina
