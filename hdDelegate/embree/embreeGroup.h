#pragma once

#include "hdDelegate/embree/compat.h"
#include "hdDelegate/embree/surface.h"

#include <memory>
#include <string>
#include <vector>

namespace patina {

struct EmbreeGroup;

/// The instances of one instancer, ready for rays.
struct InstancerNode {
    std::shared_ptr<const Instancer> prim;
    /// Uniform steps over the shutter, instance after instance: transforms[instance * steps +
    /// step].
    std::vector<mat4> transforms;
    int steps = 1;
    std::vector<EmbreeGroup*> targets; ///< per instance; null is not drawn
    std::vector<std::vector<int>> categories;

    mat4 transformAt(int instance, float time) const;
    /// @param outer id of the instance around, negative when there is none
    int id(int instance, int outer) const;
};

/// What a geometry id of a group's Embree scene stands for.
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
    std::vector<std::shared_ptr<Surface>> surfaces;
    std::vector<std::shared_ptr<InstancerNode>> nodes;
    std::vector<std::unique_ptr<GroupRecord>> records;
    RTCScene scene = nullptr;
    bool hasInstances = false;

    ~EmbreeGroup();

    /// Builds the Embree scene from surfaces and nodes; the targets must have been built.
    void build(RTCDevice device);
};

/// Ray context with the stack of instances that user geometry went through.
struct TraceContext {
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
    const EmbreeGroup* group = nullptr;           ///< being traversed
    const EmbreeGroup* hitGroup = nullptr;        ///< innermost group of hitChain
    unsigned hitNative = RTC_INVALID_GEOMETRY_ID; ///< Embree instance inside hitGroup
};

/// Marks hits that came through user geometry in RTCHit::instID[0].
constexpr unsigned throughUserGeometry = 0xfffffffeu;

} // namespace patina
