// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/compat.h"
#include "hdDelegate/scene/geometry.h"

#include <pxr/base/vt/array.h>
#include <pxr/usd/sdf/path.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace patina {

class HdPatinaRenderParam;

/// The data of a Hydra instancer, by index. The transforms are those of the instances in the space
/// of its parent, so that the scene needs no more of it.
struct HdPatinaInstanceData {
    std::vector<MotionTransform> transforms;
    std::vector<std::vector<std::string>> categories; ///< per index; may be shorter
    std::vector<Marked> marks;                        ///< per index; empty = none
    std::vector<Primvar> primvars;                    ///< per index (Vertex) or constant
    bool visible = true;
};

/// Turns Hydra's instancing (each prototype names its instancer, and the instancer tells which
/// indices draw it) into the scene's (an instancer places groups). Prototypes that one instancer
/// draws at the same indices form one group. Any thread.
class HdPatinaInstances {
public:
    /// An rprim, or a nested instancer, is drawn by an instancer at some indices.
    /// @returns the group that it belongs to
    std::string place(const SdfPath& prototype, const SdfPath& instancer,
                      const VtIntArray& indices);
    /// It is no longer drawn by any instancer.
    void leave(const SdfPath& prototype);

    /// The data of an instancer.
    /// @param group the group that it is placed in, as place() told; empty for the world
    void setInstancer(const SdfPath& instancer, const std::string& group,
                      std::shared_ptr<const HdPatinaInstanceData> data);
    void removeInstancer(const SdfPath& instancer);

    /// Every instancer that is known.
    SdfPathVector instancers();

    /// Sets every scene instancer that changed since the last call.
    void flush(HdPatinaRenderParam& param);

private:
    struct Group {
        std::vector<int> indices;
        int members = 0;
    };
    struct Entry {
        bool known = false; ///< setInstancer was called
        std::string group;
        std::shared_ptr<const HdPatinaInstanceData> data;
        std::map<std::string, Group> groups;
        bool changed = false, inScene = false;
    };
    struct Place {
        SdfPath instancer;
        std::string group;
    };

    void leaveLocked(const SdfPath& prototype);
    std::shared_ptr<const Instancer> build(const SdfPath& path, const Entry& entry,
                                           HdPatinaRenderParam& param) const;

    std::mutex _mutex;
    std::map<SdfPath, Entry> _entries;
    std::map<SdfPath, Place> _places;
};

} // namespace patina
