// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/groupTree.h"
#include "hdDelegate/embree/surfaceShapes.h"
#include "hdDelegate/plan/scenePlan.h"

#include <optional>

namespace patina {

/// A prim, and its rank among all paths, drawn or not.
template <class Prim> struct Ranked {
    std::shared_ptr<const Prim> prim;
    int rank;
};

/// The prims of a scene that have surfaces, made ready for rays, with the materials that they use.
/// Prims and materials that do not change between updates are kept.
class DrawnSurfaces {
public:
    DrawnSurfaces(CompiledScene& compiled, BuildCounts& counts);

    /// Takes over prims, all that there are. @returns whether the view was not stopped
    bool update(RTCDevice device, const SceneView& view, const GroupPlaces& places,
                const std::vector<Ranked<Geometry>>& prims);

    /// The effect of edits that leave prims in their places.
    struct Changes {
        GroupTree::Members surfaces; ///< those that differ
        bool emissive = false;       ///< those that glow, before or now, are among them
        bool meshLights = false;     ///< some are of mesh lights
    };
    /// Takes over what edits touch.
    /// @param fillsSpace there are volumes or splats
    /// @returns nothing where more has changed than prims in their places: nothing is done then
    std::optional<Changes> updateTouched(const SceneView& view, const GroupPlaces& places,
                                         const std::set<std::string>& touched, bool fillsSpace);
    void forgetSurfaces() { _surfaces.clear(); } ///< they stand in another space
    void clear();

    Subdivision subdivision; ///< how finely all are drawn
    std::shared_ptr<const MaterialProgram> program(const std::string& path, const std::string& user,
                                                   const SceneView& view);

    const GroupTree::Members& members() const { return _members; }
    std::shared_ptr<const Surface> find(const std::string& path) const; ///< or null
    /// Those with a material for which `wanted` holds, in the order of their paths.
    std::vector<const Surface*> with(bool (*wanted)(const MaterialProgram&)) const;
    /// Finds those that glow.
    void collectEmissive(const Placements& placements);
    const std::vector<const Surface*>& emissive() const { return _emissive; }
    const std::vector<std::shared_ptr<const void>>& emissiveSources() const { return _sources; }
    ScenePlan plan() const;
    std::map<const MaterialProgram*, std::string> materialNames() const;

    /// Of all surfaces.
    struct Totals {
        size_t translucent = 0, withMedia = 0, withPriority = 0, bytes = 0, triangles = 0;
    };
    const Totals& totals() const { return _totals; }
    size_t bytes() const { return _totals.bytes + _shapes.bytes(); }
    size_t triangles() const { return _totals.triangles + _shapes.triangles(); }

private:
    /// A prim that is drawn.
    struct Drawn {
        std::shared_ptr<const Geometry> prim;
        float edge = 0.0f;
        Programs displacers;
        std::optional<ShapeKey> key;
        std::shared_ptr<const SharedShape> shared;
        std::shared_ptr<Surface> surface;
        std::shared_ptr<const PrimExtent> extent; ///< of `prim`; null where nobody has asked
        bool keepsRest = false; ///< Surface::rest has all, so that a move is no new shape
        int rank = 0;
        size_t member = 0; ///< index in its group's members()
        bool opaque = true, hasMedia = false, hasPriority = false, emits = false;
        size_t bytes = 0;
    };
    /// The target state of a prim.
    struct Work {
        std::shared_ptr<const Geometry> prim;
        Drawn* drawn;
        int rank;
        float edge = 0.0f;
        Programs displacers;
        std::optional<ShapeKey> key;
        std::shared_ptr<const SharedShape> shared;
    };
    Work workOf(const Ranked<Geometry>& prim, Drawn& drawn, const SceneView& view,
                EdgeTargets& edges);
    /// @returns whether the view was not stopped
    bool doWork(std::vector<Work>& work, const SceneView& view);
    void doWork(const Work& work, const SceneView& view);
    /// Gives a surface its materials and ids.
    void describe(Drawn& drawn, const SceneView& view);
    void count(const Drawn& drawn, bool isThere);
    MaterialSlot makeSlot(const Surface& surface, const std::string& material,
                          const SceneView& view);
    /// The programs of a prim's materials as displace() takes them; empty when none displaces.
    Programs displacers(const Geometry& prim, const SceneView& view);
    /// Whether a material of a prim makes it a light.
    bool glows(const Geometry& prim, const SceneView& view);

    CompiledScene& _compiled;
    Diagnostics& _diagnostics;
    BuildCounts& _counts;
    SharedShapes _shapes;
    std::map<std::string, Drawn> _surfaces;
    std::map<std::string, std::shared_ptr<const MaterialProgram>> _programs; ///< in use, by path
    GroupTree::Members _members;
    std::map<std::string, const Drawn*> _emitting; ///< by path
    std::vector<const Surface*> _emissive;
    std::vector<std::shared_ptr<const void>> _sources;
    Totals _totals;
};

} // namespace patina
