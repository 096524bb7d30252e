// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/drawnSurfaces.h"
#include "hdDelegate/embree/media/filledSpace.h"
#include "hdDelegate/embree/worldRays.h"

namespace patina {

/// Embree's view of a scene: prims in the world are baked into one acceleration structure,
/// prototypes into one each, and instances refer to them, nested to any depth.
class EmbreeScene : public WorldRays {
public:
    /// @param compiled outlives this
    explicit EmbreeScene(CompiledScene& compiled);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Brings the structures to a state of the scene. Prims, materials and prototypes that did not
    /// change since the last call are kept. If only edits changed, only the prims that they touch
    /// are visited.
    /// @param stop is polled; the build gives up early when it becomes true
    /// @param origin in the world: all places and rays are relative to it, except those of
    ///        instances inside of groups
    /// @throws std::bad_alloc; the next update completes the work that this one did not
    void update(const SceneState& state, const Camera& camera, const RenderSettings& settings,
                const std::atomic<bool>& stop, const dvec3& origin = dvec3(0.0));
    /// Whether the last update may have changed what lights are made from.
    bool lightsMayDiffer() const { return _lightsMayDiffer; }
    const dvec3& origin() const { return _space.origin; }

    /// No material lets shadow rays through, so that occluded() is an answer.
    bool allOpaque() const { return _surfaces.totals().translucent == 0; }
    const VolumeScene& volumes() const { return _filled.volumes; }
    const SplatScene& splats() const { return _filled.splats; }
    bool fillsSpace() const { return _fillsSpace; } ///< there are volumes or splats
    /// What volumes and splats let through; of volumes an estimate.
    vec3 transmittance(const SplatScene::Ray& ray, Sampler& sampler) const {
        return _filled.transmittance(ray, sampler);
    }
    bool hasMedia() const { return _surfaces.totals().withMedia > 0; } ///< in some object
    bool ranksMedia() const { return _ranksMedia; } ///< some prim has a dielectric priority
    int priorityOf(const Hit& hit) const { return _ranksMedia ? dielectricPriorityOf(hit) : 0; }

    const DrawnSurfaces& surfaces() const { return _surfaces; }
    const GroupPlaces& places() const { return _places; }
    const LinkNames& links() const { return *_parts.links; }
    vec3 boundsMin() const { return _boundsMin; }
    vec3 boundsMax() const { return _boundsMax; }
    size_t instanceCount() const { return _groups.instanceCount(); }
    const BuildCounts& counts() const { return _counts; } ///< since construction
    size_t bytes() const;                                 ///< of meshes and Embree's structures

private:
    static void onError(void* self, RTCError code, const char* text);
    void updateAll(const SceneView& view);
    /// @returns false where more than prims in their places has changed: nothing is done then
    bool updateTouched(const SceneView& view, const SceneEdits& edits);
    void updateFilled(const SceneView& view,
                      const std::vector<std::shared_ptr<const Volume>>& volumes,
                      const std::vector<SplatScene::Prim>& splats);
    void takeBounds();

    CompiledScene& _compiled;
    RTCDevice _device = nullptr;
    BuildCounts _counts;
    std::atomic<int64_t> _embreeBytes{0};
    std::atomic<bool> _outOfMemory{false}; ///< of Embree, since the last update began
    // The input of the last update.
    bool _complete = false; ///< it was not stopped
    uint64_t _version = 0;
    Camera _camera;
    RenderSettings _settings; ///< as asked for
    CompiledState _parts;
    TracedSpace _space;

    DrawnSurfaces _surfaces;
    GroupTree _groups;
    GroupPlaces _places;
    FilledSpace _filled;
    bool _fillsSpace = false, _instancesRank = false, _ranksMedia = false, _lightsMayDiffer = true;
    vec3 _boundsMin{0.0f}, _boundsMax{0.0f};
};

} // namespace patina
