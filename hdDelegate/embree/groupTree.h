// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/embreeGroup.h"
#include "hdDelegate/embree/sceneView.h"

#include <map>
#include <set>

namespace patina {

/// The world and the prototypes as groups that Embree traces, with the instances in them.
class GroupTree {
public:
    using Members = std::map<std::string, EmbreeGroup::Surfaces>; ///< by group

    GroupTree(Diagnostics& diagnostics, BuildCounts& counts)
        : _diagnostics(diagnostics), _counts(counts) {}

    /// Brings all groups to their members.
    /// @returns the world, or null where the view was stopped; the next build completes the work
    EmbreeGroup* build(RTCDevice device, const SceneView& view, const Members& surfaces);
    /// The same where no surfaces but these differ, and all instancers stay.
    EmbreeGroup* rebuild(RTCDevice device, const SceneView& view, const Members& changed);
    /// Instances stand in another space.
    void forgetInstances() { _nodes.clear(); }
    void clear();
    size_t instanceCount() const { return _instanceCount; } ///< after build()

private:
    /// What one build has to know everywhere.
    struct Build {
        RTCDevice device;
        const SceneView& view;
        const Members& surfaces;
        bool onlyChanged; ///< `surfaces` are those that differ
    };
    EmbreeGroup* group(const Build& build, const std::string& name, int depth);
    void replace(const Build& build, EmbreeGroup& group, const EmbreeGroup::Nodes* nodes);
    void noteChange(EmbreeGroup& group);
    EmbreeGroup* finished(const std::string& name) const; ///< by this build; or null
    std::shared_ptr<InstancerNode> node(const SceneView& view,
                                        const std::shared_ptr<const Instancer>& prim);
    std::shared_ptr<InstancerNode> currentNode(const SceneView& view,
                                               const std::shared_ptr<const Instancer>& prim);

    Diagnostics& _diagnostics;
    BuildCounts& _counts;
    std::map<std::string, std::unique_ptr<EmbreeGroup>> _groups; ///< by name; "" is the world
    std::map<std::string, std::shared_ptr<InstancerNode>> _nodes;
    std::set<std::string> _building, _finished; ///< by the last build
    uint64_t _version = 0;
    size_t _instanceCount = 0;
};

} // namespace patina
