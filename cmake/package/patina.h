// SPDX-License-Identifier: Apache-2.0
#pragma once
// All that a host includes. Other headers are installed because these include them; they may change
// with every version.

#include "base/diagnostics.h"             // what was wrong with a scene
#include "hdDelegate/backends/backends.h" // makeBackend
#include "hdDelegate/film/film.h"         // accumulated pixels
#include "hdDelegate/film/imageFile.h"    // images on disk
#include "hdDelegate/renderer/renderer.h" // start, stop, progress
#include "hdDelegate/scene/camera.h"      // prims, with units and ranges
#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/light.h"
#include "hdDelegate/scene/material.h"
#include "hdDelegate/scene/scene.h"          // Scene, SceneEdit
#include "hdDelegate/scene/settings.h"       // RenderSettings
#include "materialNetwork/network/network.h" // materials as authored
#include "materialNetwork/network/value.h"
