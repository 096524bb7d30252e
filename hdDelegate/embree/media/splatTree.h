// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/splatKernels.h"
#include "hdDelegate/embree/compat.h"

#include <atomic>

namespace patina {

/// Where a ray meets a kernel: at the point where that is densest along the ray.
struct SplatHit {
    float distance = 0.0f, alpha = 0.0f;
    uint32_t place = 0, kernel = 0;

    /// Kernels at one distance have an order of their own, so that images do not depend on the
    /// order in which they are found.
    bool isBefore(const SplatHit& other) const {
        if (distance != other.distance) return distance < other.distance;
        return place != other.place ? place < other.place : kernel < other.kernel;
    }
};

/// What a ray asks of the kernels that it meets.
struct SplatQuery {
    EmbreeContext base; ///< must be first: Embree hands its address to callbacks
    const void* scene = nullptr;
    uint32_t place = 0; ///< that the ray is in
    bool sums = false;  ///< only the transmittance is asked for

    static constexpr int most = 16;
    static constexpr float slack = 1e-5f; ///< of distances, for rounding
    SplatHit after;                       ///< hits up to this one are known
    SplatHit hits[most];
    int count = 0; ///< of the nearest hits, in their order

    /// Optical depth. An integer, since its sum does not depend on the order.
    int64_t depth = 0;
    static constexpr double perUnit = 4294967296.0;

    void add(const SplatHit& hit, float& far);
};

/// The kernels of a cloud in Embree, as user geometry.
class SplatTree {
public:
    /// @param stop is polled; then the result is not usable
    SplatTree(RTCDevice device, std::shared_ptr<const SplatKernels> kernels,
              const std::atomic<bool>& stop);
    ~SplatTree();
    SplatTree(const SplatTree&) = delete;
    SplatTree& operator=(const SplatTree&) = delete;

    const SplatKernels& kernels() const { return *_kernels; }
    RTCScene scene() const { return _scene; }
    RTCBounds bounds() const;

private:
    static void boundsOf(const RTCBoundsFunctionArguments* args);
    static void meet(const RTCIntersectFunctionNArguments* args);

    std::shared_ptr<const SplatKernels> _kernels;
    RTCScene _scene = nullptr; ///< null: there are none
};

} // namespace patina
