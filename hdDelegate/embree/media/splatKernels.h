// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/compat.h"
#include "hdDelegate/scene/geometry.h"

#include <atomic>
#include <cstdint>

namespace patina {

/// A kernel ends where its alpha falls below this. It then lacks the share splatCut / opacity of
/// its integral over the image: of a Gaussian exp(-r²/2) as much lies outside of r as it is there.
constexpr float splatCut = 1.0f / 1024.0f;
/// What kernels let through counts as nothing below this.
constexpr float splatEnd = 1e-4f;

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

/// The kernels of a cloud in Embree: user geometry in the cloud's own space, whose origin is moved
/// to its middle.
class SplatKernels {
public:
    struct alignas(64) Kernel { ///< a line of the cache
        vec3 center;
        float opacity;
        mat3 toUnit; ///< into the space where the kernel is exp(-r²/2)
        float reach; ///< r² where it ends
        uint32_t particle;
    };

    /// @param stop is polled; then the result is not usable
    SplatKernels(RTCDevice device, std::shared_ptr<const SplatCloud> cloud,
                 const std::atomic<bool>& stop);
    ~SplatKernels();
    SplatKernels(const SplatKernels&) = delete;
    SplatKernels& operator=(const SplatKernels&) = delete;

    const SplatCloud& cloud() const { return *_cloud; }
    const dvec3& middle() const { return _middle; }
    bool empty() const { return _kernels.empty(); }
    RTCScene scene() const { return _scene; }
    RTCBounds bounds() const;
    size_t bytes() const; ///< without Embree's

    /// Radiance in the cloud's colour space.
    /// @param basis harmonics of the direction, see splatBasis()
    vec3 radiance(uint32_t kernel, const float* basis) const;

private:
    static void boundsOf(const RTCBoundsFunctionArguments* args);
    static void meet(const RTCIntersectFunctionNArguments* args);

    std::shared_ptr<const SplatCloud> _cloud;
    std::vector<Kernel> _kernels;
    dvec3 _middle{0.0};
    RTCScene _scene = nullptr;
};

constexpr int splatBasisSize = 16; ///< bands 0 to 3

/// The real spherical harmonics of a direction as 3D Gaussian splatting has them (Kerbl et al.
/// 2023): with the sign (-1)^m of Condon and Shortley, in each band from -l to l.
void splatBasis(const vec3& direction, float basis[splatBasisSize]);

} // namespace patina
