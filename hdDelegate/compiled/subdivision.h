// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/compiled/extents.h"
#include "hdDelegate/compiled/placements.h"
#include "hdDelegate/plan/subdivisionPlan.h"
#include "hdDelegate/scene/camera.h"

namespace patina {

/// How long edges of subdivision surfaces may be on screen, for all of a scene.
struct Subdivision {
    PlannedMethod method;    ///< without a name where nothing was planned
    float edgeLength = 0.0f; ///< pixels; 0 and below: prims are drawn as they are

    /// Displacement shows more of itself on shorter edges, which no row of the table is of.
    float edgeOf(bool displaced) const;
};

/// Chooses it once for all renderers of a scene. Thread safe.
class SubdivisionChoice {
public:
    SubdivisionChoice(CompiledMaterials& materials, Extents& extents)
        : _materials(materials), _extents(extents) {}

    /// Where each prim is at the frame, and how its material is planned, decide. Prims that only
    /// reflections show count too.
    Subdivision of(const SceneState& state, const Placements& placements, const Camera& camera,
                   const RenderSettings& settings);
    size_t planned() const; ///< since this was made

private:
    Subdivision plan(const SceneState& state, const Placements& placements, const Camera& camera,
                     const RenderSettings& settings);

    CompiledMaterials& _materials;
    Extents& _extents;
    mutable std::mutex _mutex; ///< guards what follows
    size_t _planned = 0;
    uint64_t _version = 0;
    Camera _camera;
    RenderSettings _settings;
    Subdivision _last;
    std::vector<std::shared_ptr<const void>> _held; ///< what was measured, for the next plan
};

} // namespace patina
