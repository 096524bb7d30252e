// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/raster/scene/rasterEmitters.h"
#include "hdDelegate/raster/scene/gpuInstance.h"
#include "hdDelegate/raster/scene/rasterCamera.h"
#include "hdDelegate/raster/scene/rasterDetail.h"
#include "hdDelegate/raster/scene/rasterInstances.h"
#include "hdDelegate/raster/scene/rasterMaterials.h"
#include "hdDelegate/raster/scene/rasterShapeCache.h"
#include "hdDelegate/raster/scene/rasterSplats.h"
#include "hdDelegate/raster/scene/rasterVolumes.h"
#include "hdDelegate/raster/scene/rasterCulling.h"

#include <atomic>

namespace patina {

/// Places of one prim that share a tessellation.
struct RasterGroup {
    std::shared_ptr<const Geometry> prim;
    std::shared_ptr<const RasterShape> shape;
    std::vector<uint32_t> places; ///< of the prim's RasterInstances::places(), one per instance
    /// The source of other times of the shutter; null where the points stay.
    std::shared_ptr<const RasterShapeCache::Request> deforms;
    int firstInstance = 0;
};

/// Triangles of one prim with one material, drawn at every place of a group.
struct RasterDraw {
    void show(const RasterShape& shape) {
        surface = &shape.surfaces[size_t(subset)];
        casting = shape.casting.empty() ? surface : &shape.casting[size_t(subset)];
    }

    const RasterMaterial* material = nullptr;
    std::shared_ptr<const Geometry> prim;
    const RasterSurface* surface = nullptr;
    const RasterSurface* casting = nullptr; ///< what shadow maps show
    int group = 0, subset = 0;
    /// Flags beside those of RasterShape: faces that the camera does not see, see cullStyle.
    static constexpr int cullsBack = 16, cullsFront = 32;
    bool culls() const { return (flags & (cullsBack | cullsFront)) != 0; }

    int primId = 0, flags = 0; ///< flags: of the shader's drawInfo
    uint32_t noise = 0;        ///< what triangles are counted from, for random numbers
    int values = 0;            ///< where those of instances begin, plus 1; 0: it shows none
    RasterMeshLight meshLight;
};

/// The part of a scene that a view may show.
struct RasterVisible {
    std::vector<RasterRun> runs;                  ///< of instances
    std::vector<std::pair<size_t, size_t>> group; ///< first run and the one after the last

    bool shows(const RasterDraw& draw) const {
        return !group.empty() && group[size_t(draw.group)].first < group[size_t(draw.group)].second;
    }
};

/// The geometry of a scene in buffers, at one time of the shutter.
class RasterScene {
public:
    static constexpr int deformationSteps = 8;

    /// @param compiler see RasterMaterials
    explicit RasterScene(CompiledScene& compiled, ProgramCompiler* compiler = nullptr)
        : _compiled(compiled), _diagnostics(compiled.scene()->diagnostics()),
          _materials(compiled, compiler), _shapes(compiled.shapes()),
          _volumes(compiled.volumes(), _diagnostics), _splats(compiled.splats(), _diagnostics) {}

    using Compiling = std::function<void(const RasterMaterials::Ready&)>;

    /// Brings the buffers to a state of the scene. Parts that did not change since the last call
    /// are kept; where edits are all that changed, what they touch is all that is looked at.
    /// @param origin that all places are relative to, those of the camera too: numbers of 32 bits
    /// are too coarse for shadows where places are large beside what is seen
    /// @param lights that materials are lit by: with a tolerance they decide how
    /// @param compiling is told how far the programs are; empty: what is not ready is shown as
    /// a stand-in, instead of being waited for
    void update(const SceneState& state, const vec3& origin, const RasterCamera& camera,
                const RenderSettings& settings, const RasterLightPlan& lights,
                const std::atomic<bool>& stop, const Compiling& compiling);
    /// Whether the last update may have changed what lights are made from.
    bool lightsMayDiffer() const { return _lightsMayDiffer; }
    RasterMaterials& materials() { return _materials; } ///< that update() has asked for
    const RasterMaterials& materials() const { return _materials; }
    /// Moves to another time of the shutter: transforms exactly, points that move to the nearest of
    /// deformationSteps times. @returns false when nothing moves
    bool moveTo(float timeCode);
    /// Lets go of what is held for another back end, see RasterShapeCache and RasterVolumes.
    void releaseShapes() {
        _shapes.release();
        _volumes.release();
    }

    const std::vector<RasterDraw>& draws() const { return _draws; }
    const std::vector<const RasterVolume*>& volumes() const { return _volumes.placed(); }
    const RasterSplats& splats() const { return _splats; }
    const RasterEmitters& emitters() const { return _emitters; }
    /// @param clampsNear what is before the near plane shows, too
    RasterVisible visible(const mat4& worldToClip, bool clampsNear = false) const;
    const CompiledState& parts() const { return _parts; }
    const vec3& origin() const { return _origin; }
    const vec3& boundsMin() const { return _boundsMin; } ///< of what casts shadows, and volumes
    const vec3& boundsMax() const { return _boundsMax; }
    /// Of all that a camera may see.
    vec3 seenMin() const { return glm::min(_boundsMin, _splats.boundsMin()); }
    vec3 seenMax() const { return glm::max(_boundsMax, _splats.boundsMax()); }
    size_t triangles() const { return _triangles; }
    size_t bytes() const { return _shapes.bytes(); }              ///< of shapes in buffers
    size_t shapesBuilt() const { return _shapes.built(); }        ///< since this was made
    size_t instancesWritten() const { return _instancesWritten; } ///< since this was made
    size_t trianglesDrawn() const { return _trianglesDrawn; }     ///< every instance's counted
    size_t primsLookedAt() const { return _looked; } ///< by updates, since this was made
    ScenePlan plan() const;
    size_t instanceCount() const { return _instances.size(); }
    /// Counts the updates after which shadows may differ.
    uint64_t shadowVersion() const { return _shadowVersion; }
    bool moves() const { return _moves; } ///< while the shutter is open
    /// Binds the instances to a vertex array (binding 1).
    void bind(GLuint vertexArray) const;
    /// Tells a vertex array the attributes of instance.glsl.
    static void describe(GLuint vertexArray);

private:
    /// The data of one prim.
    struct Span {
        int rank = 0;
        size_t firstGroup = 0, groups = 0, firstDraw = 0, draws = 0;
        bool emits = false, displaced = false;
        /// Its places by RasterDetail::edgeAt(); empty where it looks alike from everywhere.
        std::map<float, std::vector<uint32_t>> byEdge;
        std::shared_ptr<const PrimExtent> extent; ///< held for the next update
    };
    /// A prim's groups before it was drawn anew.
    struct Sizes {
        size_t groups, draws, instances, triangles, trianglesDrawn;
    };
    Sizes sizes() const;
    void cutTo(const Sizes& sizes);
    void updateAll(const SceneState& state, const RasterCamera& camera,
                   const RasterLightPlan& lights, const std::atomic<bool>& stop,
                   const Compiling& compiling);
    /// @returns false where more than prims in their places has changed: updateAll() has to follow
    bool updateTouched(const SceneEdits& edits, const SceneState& state, const RasterCamera& camera,
                       const std::atomic<bool>& stop, const Compiling& compiling);
    /// Adds the prims that another camera sees finer or coarser.
    void addResized(const SceneState& state, const RasterCamera& camera,
                    const std::atomic<bool>& stop, SceneEdits& edits);
    bool redraw(const std::shared_ptr<const Geometry>& prim, const SceneState& state,
                const RasterCamera& camera, RasterInstances& places);
    void showMaterials(const Geometry& prim, const SceneState& state);
    void uploadTouched(const Span& span);
    void findBounds();
    void finishPrograms(const std::atomic<bool>& stop, const Compiling& compiling);

    void prepareMaterials(const SceneState& state, RasterInstances& places);
    void addPrim(const std::shared_ptr<const Geometry>& prim, int rank, const SceneState& state,
                 const RasterCamera& camera, RasterInstances& places);
    void addGroup(RasterGroup group, const std::vector<RasterPlace>& places, const dmat4& toGroup);
    void addDraws(const std::shared_ptr<const Geometry>& prim, int rank,
                  const std::vector<const RasterMaterial*>& materials, size_t firstGroup,
                  const std::vector<RasterPlace>& places, const dmat4& toGroup);
    /// Whether a draw may show values of instances, for want of the prim's own.
    bool readsInstances(const RasterDraw& draw) const;
    bool showsInstances(const std::string& path) const; ///< the same of a prim's draws
    /// Writes down what a draw shows of instances. @returns RasterDraw::values
    int addValues(const RasterDraw& draw, const RasterGroup& group,
                  const std::vector<RasterPlace>& places);
    void upload();
    void deform(float timeCode);
    int linksOf(const std::vector<std::string>& prim, const std::vector<std::string>& place);

    CompiledScene& _compiled;
    Diagnostics& _diagnostics;
    CompiledState _parts; ///< of the last update
    // The scene of the last update.
    bool _filtered = false; ///< programs know light filters
    std::string _lightText; ///< RasterLightPlan::text() before those of programs
    bool _complete = false; ///< it was not stopped, and no material stands in for another
    uint64_t _version = 0, _shadowVersion = 0;
    Camera _camera;
    RenderSettings _settings; ///< as asked for
    bool _lightsMayDiffer = true;
    size_t _looked = 0;
    RasterMaterials _materials;
    std::vector<RasterDraw> _draws;
    RasterShapeCache _shapes;
    RasterVolumes _volumes;
    RasterSplats _splats;
    std::vector<RasterGroup> _groups;
    RasterEmitters _emitters;
    std::map<std::string, Span> _spans; ///< by path
    std::vector<GpuInstance> _instances, _written;
    std::vector<RasterBox> _boxes; ///< of instances, world space
    std::vector<int> _links;       ///< see shaders/raster/links.glsl
    std::map<std::vector<int>, int> _linkRows;
    std::vector<vec4> _values; ///< of instances, see shaders/raster/surface.vert.glsl
    GlBuffer _instanceBuffer, _linkBuffer, _valueBuffer;
    vec3 _origin{0.0f}, _boundsMin{0.0f}, _boundsMax{0.0f};
    size_t _triangles = 0, _trianglesDrawn = 0, _instancesWritten = 0;
    float _shutterOpen = 0.0f, _shutterClose = 0.0f; ///< time codes
    bool _moves = false, _instancesDiffer = false;
    Subdivision _subdivision; ///< of the last update
};

} // namespace patina
