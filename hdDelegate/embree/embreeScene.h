#pragma once

#include "hdDelegate/compiled/compiledMaterials.h"
#include "hdDelegate/embree/embreeGroup.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/embree/media/volumeScene.h"
#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/plan/scenePlan.h"
#include "hdDelegate/plan/subdivisionPlan.h"
#include "hdDelegate/scene/settings.h"

#include <atomic>
#include <map>
#include <set>

namespace patina {

class CameraRays;

enum RayMask : unsigned { RayCamera = 1, RayIndirect = 2, RayShadow = 4 };

/// A triangle that emits light, in world space.
struct EmissiveTriangle {
    const Surface* surface;
    unsigned primitive;
    vec3 vertices[3];
    mat4 groupToWorld;
    bool instanced;
};

/// How much was built.
struct BuildCounts {
    std::atomic<size_t> surfaces{0};    ///< prims made ready for rays
    std::atomic<size_t> tessellated{0}; ///< of those, that were drawn anew, not only moved
    size_t groups = 0;                  ///< acceleration structures that were committed
    size_t programs = 0;
};

/// Embree's view of a scene: prims in the world are baked into one acceleration structure,
/// prototypes into one each, and instances refer to them, nested to any depth.
class EmbreeScene {
public:
    explicit EmbreeScene(Diagnostics& diagnostics);
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Brings the structures to a state of the scene. Prims, materials and prototypes that did not
    /// change since the last call are kept.
    /// @param stop is polled; the build gives up early when it becomes true
    /// @param origin in the world: all places and rays are relative to it, those of instances
    /// inside of groups aside
    void update(const SceneState& state, const Camera& camera, const RenderSettings& settings,
                CompiledMaterials& materials, const std::atomic<bool>& stop,
                const dvec3& origin = dvec3(0.0));
    const dvec3& origin() const { return _origin; }

    /// The nearest hit. @param far in: largest distance
    bool intersect(const vec3& origin, const vec3& direction, float near, float far, float time,
                   unsigned mask, Hit& hit) const;
    /// Whether anything blocks the way. Only valid as an answer when allOpaque().
    bool occluded(const vec3& origin, const vec3& direction, float near, float far, float time,
                  unsigned mask) const;

    bool allOpaque() const { return _allOpaque; } ///< no material lets shadow rays through
    const VolumeScene& volumes() const { return _volumes; }
    bool hasMedia() const { return _hasMedia; } ///< some material fills its object
    const std::vector<EmissiveTriangle>& emissiveTriangles() const { return _emissive; }
    /// World transforms of a group (for lights inside prototypes).
    std::vector<mat4> groupTransforms(const std::string& group) const;
    int category(const std::string& name) const; ///< interned; -1 when nothing belongs to it
    vec3 boundsMin() const { return _boundsMin; }
    vec3 boundsMax() const { return _boundsMax; }
    size_t trianglesStored() const { return _trianglesStored; }
    size_t instanceCount() const { return _instanceCount; }
    /// The surface of a prim (for mesh lights); null when there is none.
    std::shared_ptr<const Surface> surfaceOf(const std::string& path) const;
    /// What emissiveTriangles() are made from; equal as long as they are.
    const std::vector<std::shared_ptr<const void>>& emissiveSources() const {
        return _emissiveSources;
    }
    const std::vector<std::shared_ptr<const void>>& drawnInstancers() const { return _instancers; }
    size_t categoryCount() const { return _categoryIds.size(); }
    const BuildCounts& counts() const { return _counts; } ///< since construction
    /// What the methods of the materials in use are expected to cost.
    ScenePlan plan() const;
    /// Paths of the materials in use, by their programs; "" is displayColor.
    std::map<const MaterialProgram*, std::string> materialNames() const;
    size_t bytes() const; ///< of meshes and Embree's structures

private:
    using Programs = std::vector<std::shared_ptr<const MaterialProgram>>;
    struct CachedSurface {
        std::shared_ptr<const Geometry> prim;
        float edgeLength = 0.0f;
        Programs displacers;
        std::shared_ptr<const SharedShape> shared;
        std::shared_ptr<Surface> surface;
        std::shared_ptr<const RestShape> rest; ///< for interactive renders
    };
    /// Of the space that the members of a group are placed in.
    dvec3 originOf(const std::string& group) const { return group.empty() ? _origin : dvec3(0.0); }
    int intern(const std::string& category);
    std::vector<int> intern(const std::vector<std::string>& categories);
    MaterialSlot makeSlot(const Surface& surface, const std::string& materialPath,
                          const SceneState& state, const RenderSettings& settings,
                          CompiledMaterials& materials);
    std::shared_ptr<const MaterialProgram> program(const std::string& path, const std::string& user,
                                                   const SceneState& state,
                                                   const RenderSettings& settings,
                                                   CompiledMaterials& materials);
    /// The programs of a prim's materials as displace() takes them; empty when none displaces.
    Programs displacers(const Geometry& prim, const SceneState& state,
                        const RenderSettings& settings, CompiledMaterials& materials);
    /// Chooses how long edges of subdivision surfaces are on screen. @returns pixels
    float planSubdivision(const SceneState& state, const CameraRays& rays,
                          const RenderSettings& settings, CompiledMaterials& materials);
    /// How long the edges of a tessellated prim may be, in its own space: --edgeLength pixels where
    /// it is nearest, rounded to a power of two so that small moves of the camera change nothing.
    /// 0: it is drawn as it is.
    /// @param displaced it has a material that moves its points
    /// @param transformsOf world transforms by group, of those asked for so far
    float targetEdge(const Geometry& prim, bool displaced, const Camera& camera,
                     const CameraRays& rays, const RenderSettings& settings,
                     std::map<std::string, std::vector<mat4>>& transformsOf) const;
    /// The roundEdge of an implicit prim of the world, see TessellationOptions. 0: all segments.
    float roundEdge(const Implicit& prim, const Camera& camera, const CameraRays& rays) const;
    /// Whether a material of a prim makes it a light.
    bool glows(const Geometry& prim, const SceneState& state, const RenderSettings& settings,
               CompiledMaterials& materials);
    /// Not baked yet.
    std::shared_ptr<Surface> shape(const std::shared_ptr<const Geometry>& prim, float edgeLength,
                                   const Programs& displacers) const;
    /// Among equal ones.
    std::shared_ptr<Surface> shape(const std::shared_ptr<const Geometry>& prim,
                                   const std::shared_ptr<const SharedShape>& shared) const;
    void updateSurface(CachedSurface& cached, const std::shared_ptr<const Geometry>& prim,
                       float edgeLength, const Programs& displacers,
                       const std::shared_ptr<const SharedShape>& shared, bool keepRest);
    std::shared_ptr<InstancerNode> node(const std::shared_ptr<const Instancer>& prim);
    std::shared_ptr<InstancerNode> currentNode(const std::shared_ptr<const Instancer>& prim);
    EmbreeGroup* finishedGroup(const std::string& name) const; ///< by this update; or null
    EmbreeGroup* buildGroup(const std::string& name, int depth, const RenderSettings& settings,
                            const std::atomic<bool>& stop);
    void gatherTransforms(const std::string& group, const mat4& tail, int depth,
                          std::vector<mat4>& out) const;
    void collectEmissive();
    /// Whether a ray may be traced. Tells once of one that may not.
    bool accepts(const RTCRay& ray) const;
    bool finishHit(const RTCRayHit& rayHit, const TraceContext& context, Hit& hit) const;

    struct CachedProgram {
        std::shared_ptr<const MaterialPrim> prim;
        std::map<std::string, std::string> methods;
        double tolerance = -1.0;
        std::shared_ptr<const MaterialProgram> program;
    };

    Diagnostics& _diagnostics;
    RTCDevice _device = nullptr;
    SharedShapes _shapes;
    std::map<std::string, CachedSurface> _surfaces;
    std::map<std::string, CachedProgram> _programs;
    PlannedMethod _subdivision; ///< of this update; without a name where nothing was planned
    std::map<std::string, std::unique_ptr<EmbreeGroup>> _groups; ///< by name; "" is the world
    std::map<std::string, std::vector<std::shared_ptr<Surface>>> _surfacesOf; ///< by group
    std::map<std::string, std::vector<std::shared_ptr<const Instancer>>> _instancersOf;
    std::vector<std::shared_ptr<const void>> _instancers; ///< that are drawn
    std::map<std::string, std::shared_ptr<InstancerNode>> _nodes;
    std::map<std::string, bool> _building;
    std::set<std::string> _finished; ///< groups that this update brought up to date
    uint64_t _groupVersion = 0;
    BuildCounts _counts;
    std::atomic<int64_t> _embreeBytes{0};
    std::vector<std::shared_ptr<const void>> _emissiveSources;
    EmbreeGroup* _world = nullptr;
    std::vector<EmissiveTriangle> _emissive;
    std::map<std::string, int> _categoryIds;
    VolumeScene _volumes;
    std::shared_ptr<const MaterialProgram> _plainVolume;
    float _shutterOpen = 0.0f, _shutterClose = 0.0f;
    dvec3 _origin{0.0};
    bool _allOpaque = true, _hasMedia = false;
    mutable std::atomic<bool> _toldOfRays{false};
    vec3 _boundsMin{0.0f}, _boundsMax{0.0f};
    size_t _trianglesStored = 0, _instanceCount = 0;
};

} // namespace patina
