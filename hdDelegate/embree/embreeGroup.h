// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/compat.h"
#include "hdDelegate/embree/surface.h"

#include <atomic>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina {

struct EmbreeGroup;

constexpr float largestTraced = 1e18f; ///< coordinates of rays and of what they meet

/// The instances of one instancer, ready for rays.
struct InstancerNode {
    std::shared_ptr<const Instancer> prim;
    /// Uniform steps over the shutter, instance after instance: transforms[instance * steps +
    /// step].
    std::vector<mat4> transforms;
    int steps = 1;
    std::vector<EmbreeGroup*> targets; ///< per instance; null is not drawn
    std::vector<uint64_t> versions; ///< per prototype of the prim: EmbreeGroup::version it is for
    std::vector<std::vector<int>> categories;
    std::shared_ptr<const InstanceValues> values;
    std::vector<bool> collapses; ///< per instance: (nearly) flat at some time; rays are checked

    mat4 transformAt(int instance, float time) const;
    /// @param outer id of the instance around, negative when there is none
    int id(int instance, int outer) const;
};

/// The meaning of a geometry id of a group's Embree scene.
struct GroupRecord {
    Surface* surface = nullptr;          ///< a prim
    const InstancerNode* node = nullptr; ///< instances
    int instance =
        -1; ///< of a single native instance; -1: user geometry, one primitive an instance
    std::vector<int> instances; ///< primitive -> instance, for user geometry
};

/// A prototype, or the world: one Embree scene.
///
/// Instances of groups without instances inside are Embree instances; those of groups that contain
/// instances are user geometry which transforms the ray itself, since an Embree library may be
/// built with a single level of instancing.
struct EmbreeGroup {
    std::string name;
    std::vector<std::unique_ptr<GroupRecord>> records; ///< by geometry id; null: not in use
    RTCScene scene = nullptr;
    bool hasInstances = false;
    bool changed = false; ///< by the last update
    uint64_t version = 0; ///< no two states of any two groups have the same; never 0
    /// Coordinates of rays up to which those of no instance in it are too large, see isTraceable().
    float rayLimit = largestTraced;

    /// What Embree builds: for speed of rays; a hierarchy per member, of which only those that
    /// change are built again; or one that refers to the members' vertices, for memory.
    enum class Structure { Fast, Editable, Compact };

    using Surfaces = std::vector<std::shared_ptr<Surface>>;
    using Nodes = std::vector<std::shared_ptr<InstancerNode>>;

    ~EmbreeGroup();
    bool empty() const { return _surfaces.empty() && _nodes.empty(); }

    /// Brings the Embree scene to these members. Members that it has stay; without any change
    /// nothing is committed. The nodes' targets must have been updated.
    /// @param stop cancels the commit; the next update then starts anew
    void update(RTCDevice device, const Surfaces& surfaces, const Nodes& nodes, Structure structure,
                const std::atomic<bool>& stop);
    /// The same after an update with the same structure, where no surfaces but these differ.
    /// @param nodes null: none of them differs
    void replace(RTCDevice device, const Surfaces& surfaces, const Nodes* nodes,
                 const std::atomic<bool>& stop);

private:
    struct SurfaceMember {
        std::shared_ptr<Surface> surface;
        unsigned mask = 0, id = 0;
        float rayLimit = largestTraced;
    };
    struct NodeMember {
        std::shared_ptr<InstancerNode> node;
        std::vector<unsigned> ids;
        float rayLimit = largestTraced;
    };

    void clear();
    unsigned freeId();
    void attach(RTCGeometry geometry, unsigned id, unsigned mask, GroupRecord record);
    void detach(unsigned id);
    void updateSurfaces(RTCDevice device, const Surfaces& surfaces);
    void showTo(SurfaceMember& member, unsigned mask); ///< rays of this mask
    /// @param id that it gets if that is free; -1: any
    void attachSurface(RTCDevice device, const std::shared_ptr<Surface>& surface, int id,
                       std::map<std::string, SurfaceMember>& members);
    void commit(RTCDevice device, const std::atomic<bool>& stop);
    void updateNodes(RTCDevice device, const Nodes& nodes);
    void attachNode(RTCDevice device, NodeMember& member);

    std::map<std::string, SurfaceMember> _surfaces; ///< by path; only what has geometry
    std::map<std::string, NodeMember> _nodes;       ///< by path; only what has instances
    size_t _firstFree = 0;                          ///< no id below is free
    Structure _structure = Structure::Fast;
    bool _broken = false; ///< an update was stopped or ran out of memory: the next starts anew
};

/// Rays that Embree's debugging builds do not abort at: no NaN, no distance below 0, numbers
/// up to 1.8e18. Asked of every ray before it gets there.
/// @param limit of the coordinates of the origin
inline bool isTraceable(const RTCRay& ray, float limit) {
    const auto within = [](float x, float y, float z, float maximum) {
        return std::abs(x) <= maximum && std::abs(y) <= maximum && std::abs(z) <= maximum;
    };
    return within(ray.org_x, ray.org_y, ray.org_z, limit) &&
           within(ray.dir_x, ray.dir_y, ray.dir_z, largestTraced) && ray.tnear >= 0.0f &&
           ray.tnear <= INFINITY && ray.tfar >= 0.0f && ray.time >= 0.0f && ray.time <= 1.0f;
}

/// Ray context with the stack of instances that user geometry went through.
struct TraceContext {
    explicit TraceContext(const EmbreeGroup* world) : group(world) { initContext(&base); }

    EmbreeContext base; ///< must be first: Embree hands its address to callbacks
    static constexpr int maxDepth = 8;
    struct Entry {
        const GroupRecord* record;
        int instance;
    };
    int depth = 0;
    Entry stack[maxDepth];
    int hitDepth = 0;
    Entry hitChain[maxDepth];
    const EmbreeGroup* group;                     ///< being traversed
    const EmbreeGroup* hitGroup = nullptr;        ///< innermost group of hitChain
    unsigned hitNative = RTC_INVALID_GEOMETRY_ID; ///< Embree instance inside hitGroup
};

/// Marks hits that came through user geometry in RTCHit::instID[0].
constexpr unsigned throughUserGeometry = 0xfffffffeu;

} // namespace patina
