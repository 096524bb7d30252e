// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/embree/embreeGroup.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/embree/media/splatScene.h"
#include "hdDelegate/embree/media/volumeScene.h"
#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/plan/scenePlan.h"
#include "hdDelegate/plan/subdivisionPlan.h"
#include "hdDelegate/scene/settings.h"

#include <atomic>
#include <functional>
#include <map>
#include <optional>
#include <set>

namespace patina {

/// Of a surface alone: none where it shares them.
size_t trianglesOf(const Surface& surface);

/// How much was built.
struct BuildCounts {
    std::atomic<size_t> surfaces{0};    ///< prims made ready for rays
    std::atomic<size_t> tessellated{0}; ///< of those, that were drawn anew, not only moved
    size_t groups = 0;                  ///< acceleration structures that were committed
    size_t programs = 0;
    size_t looked = 0; ///< prims that an update looked at to see whether anything is to be done
};

/// Where a group is in the space that rays are traced in.
struct GroupPlace {
    mat4 toWorld{1.0f};
    std::vector<InstanceStep> steps; ///< from the outermost instance inwards
};

/// Embree's view of a scene: prims in the world are baked into one acceleration structure,
/// prototypes into one each, and instances refer to them, nested to any depth.
class EmbreeScene {
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
    const dvec3& origin() const { return _origin; }

    /// The nearest hit. @param far in: largest distance
    bool intersect(const vec3& origin, const vec3& direction, float near, float far, float time,
                   unsigned mask, Hit& hit) const;
    /// Whether anything blocks the way. Only valid as an answer when allOpaque().
    bool occluded(const vec3& origin, const vec3& direction, float near, float far, float time,
                  unsigned mask) const;
    static constexpr int packet = 16; ///< rays that occludedRays takes at once
    /// The same for up to `packet` rays from one point to any distance, in less time than each
    /// alone. @param directions of length 1
    /// @returns bit i: something blocks ray i
    unsigned occludedRays(const vec3& origin, const vec3* directions, int count, float time,
                          unsigned mask) const;

    bool allOpaque() const { return _translucent == 0; } ///< no material lets shadow rays through
    const VolumeScene& volumes() const { return _volumes; }
    const SplatScene& splats() const { return _splats; }
    bool fillsSpace() const { return _fillsSpace; } ///< there are volumes or splats
    /// What volumes and splats let through; of volumes an estimate.
    vec3 transmittance(const SplatScene::Ray& ray, Sampler& sampler) const;
    bool hasMedia() const { return _withMedia > 0; } ///< some material fills its object
    bool ranksMedia() const { return _ranksMedia; }  ///< some prim has a dielectric priority
    int priorityOf(const Hit& hit) const { return _ranksMedia ? dielectricPriorityOf(hit) : 0; }
    /// Those with a material that glows, in the order of their paths.
    const std::vector<const Surface*>& emissiveSurfaces() const { return _emissive; }
    /// Those with a material for which `wanted` holds, in the order of their paths.
    std::vector<const Surface*> surfacesWith(bool (*wanted)(const MaterialProgram&)) const;
    /// World transforms of a group (for lights inside prototypes).
    std::vector<mat4> groupTransforms(const std::string& group) const;
    /// The same, one after the other.
    void forTransforms(const std::string& group,
                       const std::function<void(const mat4&)>& visit) const;
    double placeCount(const std::string& group) const { return _parts.placements->count(group); }
    /// The same with the instances around. Their values live as long as sharedPlacements().
    std::vector<GroupPlace> groupPlaces(const std::string& group) const;
    const LinkNames& links() const { return *_parts.links; }
    vec3 boundsMin() const { return _boundsMin; }
    vec3 boundsMax() const { return _boundsMax; }
    size_t trianglesStored() const { return _trianglesStored; }
    size_t instanceCount() const { return _instanceCount; }
    /// The surface of a prim (for mesh lights); null when there is none.
    std::shared_ptr<const Surface> surfaceOf(const std::string& path) const;
    /// The key of the light of emissiveSurfaces(): equal as long as that light is.
    const std::vector<std::shared_ptr<const void>>& emissiveSources() const {
        return _emissiveSources;
    }
    const Placements& placements() const { return *_parts.placements; }
    const std::shared_ptr<const Placements>& sharedPlacements() const { return _parts.placements; }
    const BuildCounts& counts() const { return _counts; } ///< since construction
    /// The expected costs of the methods of the materials in use.
    ScenePlan plan() const;
    /// Paths of the materials in use, by their programs; "" is displayColor.
    std::map<const MaterialProgram*, std::string> materialNames() const;
    size_t bytes() const; ///< of meshes and Embree's structures

private:
    using Programs = std::vector<std::shared_ptr<const MaterialProgram>>;
    using Members = std::map<std::string, EmbreeGroup::Surfaces>; ///< by group
    /// A prim that is drawn.
    struct CachedSurface {
        std::shared_ptr<const Geometry> prim;
        float edgeLength = 0.0f;
        Programs displacers;
        std::optional<ShapeKey> key;
        std::shared_ptr<const SharedShape> shared;
        std::shared_ptr<Surface> surface;
        std::shared_ptr<const PrimExtent> extent; ///< of `prim`; null where nobody has asked
        bool keepsRest = false; ///< Surface::rest has all, so that a move is no new shape
        int rank = 0;           ///< of the path among all, drawn or not
        size_t member = 0;      ///< index in _surfacesOf
        bool opaque = true, hasMedia = false, hasPriority = false, emits = false;
        size_t bytes = 0;
    };
    /// The target state of a prim.
    struct Work {
        std::shared_ptr<const Geometry> prim;
        CachedSurface* cached;
        float edge;
        int rank;
        Programs displacers;
        std::optional<ShapeKey> key;
        std::shared_ptr<const SharedShape> shared = nullptr;
    };
    /// How one update looks at a scene.
    struct View {
        const SceneState& state;
        const Camera& camera;
        const RenderSettings& settings;
        const ScreenScale& screen;
        const std::atomic<bool>& stop;
        std::map<std::string, std::vector<mat4>> transformsOf; ///< by group, of those asked for
        /// By group: the surfaces that differ from the last update's. Null: all of them may.
        const Members* changed = nullptr;
    };
    static void onError(void* self, RTCError code, const char* text);
    void updateAll(View& view);
    /// @returns false where more than prims in their places has changed: nothing is done then
    bool updateTouched(View& view, const SceneEdits& edits);
    std::optional<std::vector<Work>> touchedWork(View& view, const SceneEdits& edits);
    void rebuildGroups(const View& view); ///< those with View::changed
    Work workOf(const std::shared_ptr<const Geometry>& prim, CachedSurface& cached, int rank,
                View& view);
    void updateSurfaces(std::vector<Work>& work, const View& view);
    /// Gives a surface its materials and ids.
    void describe(CachedSurface& cached, const View& view);
    void forget(const CachedSurface& cached); ///< what describe() has counted
    void takeBounds();
    void updateVolumes(const View& view, const std::vector<std::shared_ptr<const Volume>>& prims);
    void updateSplats(const View& view, const std::vector<SplatScene::Prim>& prims);
    /// Of the space that the members of a group are placed in.
    dvec3 originOf(const std::string& group) const { return group.empty() ? _origin : dvec3(0.0); }
    MaterialSlot makeSlot(const Surface& surface, const std::string& materialPath,
                          const View& view);
    std::shared_ptr<const MaterialProgram> program(const std::string& path, const std::string& user,
                                                   const View& view);
    /// The programs of a prim's materials as displace() takes them; empty when none displaces.
    Programs displacers(const Geometry& prim, const View& view);
    /// How long the edges of a tessellated prim may be, in its own space: --edgeLength pixels where
    /// it is nearest, rounded to a power of two so that small moves of the camera change nothing.
    /// 0: it is drawn as it is.
    /// @param displaced it has a material that moves its points
    float targetEdge(CachedSurface& cached, const std::shared_ptr<const Geometry>& prim,
                     bool displaced, View& view);
    /// The roundEdge of an implicit prim of the world, see TessellationOptions. 0: all segments.
    float roundEdge(const Implicit& prim, const View& view) const;
    /// Whether a material of a prim makes it a light.
    bool glows(const Geometry& prim, const View& view);
    /// Not baked yet.
    std::shared_ptr<Surface> shape(const std::shared_ptr<const Geometry>& prim, float edgeLength,
                                   const Programs& displacers, bool keepRest) const;
    /// Among equal ones.
    std::shared_ptr<Surface> shape(const std::shared_ptr<const Geometry>& prim,
                                   const std::shared_ptr<const SharedShape>& shared) const;
    void updateSurface(const Work& work, bool keepRest);
    std::shared_ptr<InstancerNode> node(const std::shared_ptr<const Instancer>& prim);
    std::shared_ptr<InstancerNode> currentNode(const std::shared_ptr<const Instancer>& prim);
    EmbreeGroup* finishedGroup(const std::string& name) const; ///< by this update; or null
    EmbreeGroup* buildGroup(const std::string& name, int depth, const View& view);
    void collectEmissive();
    /// Whether a ray may be traced. Tells once of one that may not.
    bool accepts(const RTCRay& ray) const;
    bool finishHit(const RTCRayHit& rayHit, const TraceContext& context, Hit& hit) const;

    CompiledScene& _compiled;
    Diagnostics& _diagnostics;
    RTCDevice _device = nullptr;
    CompiledState _parts; ///< of the last update
    // The input of the last update.
    bool _complete = false; ///< it was not stopped
    uint64_t _version = 0;
    Camera _camera;
    RenderSettings _settings; ///< as asked for
    SharedShapes _shapes;
    std::map<std::string, CachedSurface> _surfaces;
    std::map<std::string, std::shared_ptr<const MaterialProgram>> _programs; ///< in use, by path
    Subdivision _subdivision;                                                ///< of the last update
    std::map<std::string, std::unique_ptr<EmbreeGroup>> _groups; ///< by name; "" is the world
    Members _surfacesOf;
    std::map<std::string, const CachedSurface*> _emitting; ///< by path
    std::map<std::string, std::shared_ptr<InstancerNode>> _nodes;
    std::map<std::string, bool> _building;
    std::set<std::string> _finished; ///< groups that this update brought up to date
    uint64_t _groupVersion = 0;
    BuildCounts _counts;
    std::atomic<int64_t> _embreeBytes{0};
    std::vector<std::shared_ptr<const void>> _emissiveSources;
    EmbreeGroup* _world = nullptr;
    std::vector<const Surface*> _emissive;
    VolumeScene _volumes;
    SplatScene _splats;
    bool _fillsSpace = false;
    float _shutterOpen = 0.0f, _shutterClose = 0.0f;
    bool _withMoments = false;           ///< an AOV tells motion
    dvec3 _origin{0.0}, _builtFrom{0.0}; ///< of the last update; of what is cached
    size_t _translucent = 0, _withMedia = 0, _withPriority = 0,
           _surfaceBytes = 0; ///< of all surfaces
    bool _instancesRank = false, _ranksMedia = false;
    bool _lightsMayDiffer = true;
    mutable std::atomic<bool> _warnedOfRays{false};
    std::atomic<bool> _outOfMemory{false}; ///< of Embree, since the last update began
    vec3 _boundsMin{0.0f}, _boundsMax{0.0f};
    size_t _trianglesStored = 0, _instanceCount = 0;
};

} // namespace patina
