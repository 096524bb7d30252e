// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledScene.h"
#include "hdDelegate/embree/surfaceSpace.h"
#include "hdDelegate/plan/primExtent.h"
#include "hdDelegate/scene/camera.h"

#include <atomic>

namespace patina {

/// Where and when rays are traced: all that is ready for them is made for one such space.
struct TracedSpace {
    dvec3 origin{0.0};               ///< in the world; the spaces of other groups have their own
    float open = 0.0f, close = 0.0f; ///< times of the shutter
    bool withMoments = false;        ///< an AOV tells motion

    bool operator==(const TracedSpace& o) const {
        return origin == o.origin && open == o.open && close == o.close &&
               withMoments == o.withMoments;
    }
    /// Of the space that the members of a group are placed in.
    dvec3 originOf(const std::string& group) const { return group.empty() ? origin : dvec3(0.0); }
    /// A transform into a group, at uniform steps over the shutter.
    std::vector<mat4> steps(const MotionTransform& transform, const std::string& group) const {
        return resample(transform, open, close, originOf(group));
    }
    /// The same for things that stand still.
    mat4 still(const MotionTransform& transform, const std::string& group) const {
        return interpolate(transform, 0.0f, originOf(group));
    }
};

/// How one update looks at a scene.
struct SceneView {
    const SceneState& state;
    const Camera& camera;
    const RenderSettings& settings;
    const CompiledState& parts;
    const ScreenScale& screen;
    const TracedSpace& space;
    const std::atomic<bool>& stop; ///< is polled
};

/// How much was built.
struct BuildCounts {
    std::atomic<size_t> surfaces{0};    ///< prims made ready for rays
    std::atomic<size_t> tessellated{0}; ///< of those, that were drawn anew, not only moved
    size_t groups = 0;                  ///< acceleration structures that were committed
    size_t programs = 0;
    size_t looked = 0; ///< prims that an update looked at to see whether anything is to be done
};

} // namespace patina
