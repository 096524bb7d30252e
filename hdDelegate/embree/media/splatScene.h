// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/media/splatLights.h"
#include "hdDelegate/embree/media/splatTree.h"

#include <functional>
#include <map>
#include <memory>

namespace patina {

/// Where a group is, at uniform steps over the shutter.
struct MovingPlace {
    std::vector<mat4> toWorld{mat4(1.0f)};
    unsigned mask = RayAny; ///< rays that see it, of RayMask
    bool matte = false;

    /// Takes the place into the space around.
    void enter(const std::vector<mat4>& around);
};

/// All splats of a scene. Each kernel has an alpha, its opacity times exp(-d²/2), with d the
/// distance from its middle in standard deviations, at the point of the ray where that is least
/// (Knoll et al. 2021; Moenne-Loccoz et al. 2024). Kernels are composited in the order of these
/// points. Immutable between updates.
class SplatScene {
public:
    using PlacesOf = std::function<std::vector<MovingPlace>(const std::string& group)>;
    struct Prim {
        std::shared_ptr<const Splats> splats;
        int id = 0; ///< for the AOV primId
    };

    SplatScene() = default;
    ~SplatScene() { clear(); }
    SplatScene(const SplatScene&) = delete;
    SplatScene& operator=(const SplatScene&) = delete;

    /// Takes over the splats of a scene.
    /// @param open, close times of the shutter
    /// @param origin of the space that they are wanted in, see seenFrom()
    void update(RTCDevice device, CompiledSplats& compiled, const std::vector<Prim>& prims,
                const PlacesOf& placesOf, float open, float close, const dvec3& origin,
                const RenderingSpace& space, const std::atomic<bool>& stop,
                Diagnostics& diagnostics);
    void clear();

    bool empty() const { return _placed.empty(); }
    vec3 boundsMin() const { return _min; } ///< world
    vec3 boundsMax() const { return _max; }
    size_t bytes() const { return _bytes; } ///< without Embree's

    struct Ray {
        vec3 origin, direction;
        float near = 0.0f, far = INFINITY, time = 0.0f;
        unsigned rays = RayAny; ///< kind, of RayMask
    };
    /// Visits the kernels along a ray, the nearest first.
    /// @param visit (hit) is false when it has seen enough
    template <class Visit> void along(const Ray& ray, const Visit& visit) const {
        SplatQuery query;
        query.after.distance = -INFINITY;
        for (;;) {
            gather(ray, query);
            for (int i = 0; i < query.count; ++i)
                if (!visit(query.hits[i])) return;
            if (query.count < SplatQuery::most) return;
            query.after = query.hits[SplatQuery::most - 1];
        }
    }
    /// What the kernels along a ray let through.
    float transmittance(const Ray& ray) const;

    const SplatLights& lights() const { return _lights; }
    bool isMatte(const SplatHit& hit) const { return _placed[hit.place].matte; }
    int primId(const SplatHit& hit) const { return _placed[hit.place].id; }

    /// Colours along one ray.
    class Look {
    public:
        Look(const SplatScene& scene, const Ray& ray) : _scene(scene), _ray(ray) {}
        vec3 radiance(const SplatHit& hit);

    private:
        const SplatScene& _scene;
        const Ray& _ray;
        int64_t _place = -1; ///< that the basis is for
        shSplats::SplatBasis _basis;
    };

private:
    struct Placed {
        std::shared_ptr<const SplatTree> tree;
        std::vector<mat4> toWorld; ///< steps
        mat4 toLocal{1.0f};        ///< where there is one
        unsigned mask = RayAny;
        bool matte = false;
        int id = 0;
        ColorTransformPtr toRendering; ///< null: the radiance is of the rendering space

        mat4 worldToLocal(float time) const;
    };
    void gather(const Ray& ray, SplatQuery& query) const;
    void trace(const Ray& ray, SplatQuery& query) const;
    void place(const Prim& prim, const std::shared_ptr<const SplatTree>& tree,
               const PlacesOf& placesOf, float open, float close, const dvec3& origin,
               const RenderingSpace& space, Diagnostics& diagnostics);
    static void boundsOf(const RTCBoundsFunctionArguments* args);
    static void enter(const RTCIntersectFunctionNArguments* args);

    std::map<std::shared_ptr<const SplatCloud>, std::shared_ptr<const SplatTree>> _trees;
    std::vector<Placed> _placed;
    SplatLights _lights;
    RTCScene _scene = nullptr; ///< of the places
    size_t _bytes = 0;
    vec3 _min{INFINITY}, _max{-INFINITY};
};

} // namespace patina
