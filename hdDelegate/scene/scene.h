// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/scene/camera.h"
#include "hdDelegate/scene/geometry.h"
#include "hdDelegate/scene/light.h"
#include "hdDelegate/scene/material.h"
#include "hdDelegate/scene/primMap.h"
#include "hdDelegate/scene/sceneDelta.h"
#include "materialNetwork/color/colorSpaces.h"
#include "base/diagnostics.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace patina {

/// The whole scene at one moment. Prims are immutable: an edited prim is another object, so that
/// a renderer sees what changed by comparing pointers.
struct SceneState {
    uint64_t version = 0;
    PrimMap<Geometry> geometry;
    PrimMap<Instancer> instancers;
    PrimMap<Light> lights;
    PrimMap<Camera> cameras;
    PrimMap<MaterialPrim> materials;
    double metersPerUnit = 0.01;
    /// Which colours are given in: those of lights and primvars, after the host has read them.
    const RenderingSpace* renderingSpace = &RenderingSpace::rec709();
    uint64_t triangles = 0; ///< of all geometry, see trianglesOf()
};

/// @returns whether both hold the same prim objects, versions aside
bool sameContent(const SceneState& a, const SceneState& b);

class SceneEdit;

enum class PrimKind { Any, Geometry, Instancer, Light, Camera, Material };

/// The renderer's own scene. Hosts edit it from any thread; renderers read snapshots.
class Scene {
public:
    Scene();

    /// Opens an edit. Several may be open at once, from several threads; each is atomic when it
    /// commits.
    SceneEdit edit();

    /// The state after the last commit.
    std::shared_ptr<const SceneState> snapshot() const;

    /// The changes of all commits from one version to a later one.
    /// @returns nothing where that is not known any more: everything may differ
    std::optional<SceneDelta> changes(uint64_t from, uint64_t to) const;

    Diagnostics& diagnostics() { return _diagnostics; }

private:
    friend class SceneEdit;
    mutable std::mutex _mutex;
    std::shared_ptr<const SceneState> _state;
    EditLog _log; ///< guarded by _mutex
    Diagnostics _diagnostics;
};

/// A batch of changes. Commits when told to, or when it goes out of scope.
class SceneEdit {
public:
    explicit SceneEdit(Scene& scene) : _scene(&scene) {}
    SceneEdit(SceneEdit&& other) noexcept;
    SceneEdit(const SceneEdit&) = delete;
    SceneEdit& operator=(const SceneEdit&) = delete;
    ~SceneEdit() { commit(); }

    /// Prims whose transform no ray could follow are left out with a warning, see isPlace(); of
    /// cameras what cannot be used is replaced, see checkedCamera().
    void set(std::shared_ptr<const Geometry> prim);
    void set(std::shared_ptr<const Instancer> prim);
    void set(std::shared_ptr<const Light> prim);
    void set(std::shared_ptr<const Camera> prim);
    void set(std::shared_ptr<const MaterialPrim> prim);
    void setMetersPerUnit(double metersPerUnit);
    /// Hosts set it before they give colours, and give all prims anew after it has changed.
    void setRenderingSpace(const RenderingSpace& space) { _renderingSpace = &space; }
    /// A path may hold prims of several kinds (a mesh that is a light, say).
    void remove(const std::string& path, PrimKind kind = PrimKind::Any);
    void clear(); ///< removes everything
    /// A prim that would take the scene beyond its limits is left out, see SceneLimits.
    void commit();

private:
    template <class T> bool stands(const T& prim, PrimKind kind, const MessageMaker<1>& what);
    template <class F> void forMaps(PrimKind kind, const F& f);

    Scene* _scene;
    bool _clear = false; ///< before all changes
    double _metersPerUnit = -1.0;
    const RenderingSpace* _renderingSpace = nullptr;
    // By path; null where the prim is removed.
    PrimMap<Geometry>::Changes _geometry;
    PrimMap<Instancer>::Changes _instancers;
    PrimMap<Light>::Changes _lights;
    PrimMap<Camera>::Changes _cameras;
    PrimMap<MaterialPrim>::Changes _materials;
};

} // namespace patina
