// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/scene.h"

#include <string>

namespace patina {

/// The scene as text, the same for the same scene: prims sorted by path, only fields that differ
/// from their default, numbers with up to six digits. Made for tests that compare what two hosts
/// translated, before any pixel.
/// @param maxValues arrays longer than this are cut and end with their length and a checksum
std::string dumpScene(const SceneState& scene, int maxValues = 16);

} // namespace patina
