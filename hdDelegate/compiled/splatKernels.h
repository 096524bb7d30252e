// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/diagnostics.h"
#include "hdDelegate/compiled/madeOnce.h"
#include "hdDelegate/scene/geometry.h"
#include "materialNetwork/color/colorSpaces.h"
#include "shaders/splat.h"

#include <cstdint>

namespace patina {

/// shaders/raster/splats.frag.glsl reads it as four rows.
struct alignas(64) SplatKernel {
    vec3 center;
    float opacity;
    mat3 toUnit; ///< into the kernel's own space, see shaders/lib/splat.glsl
    float reach; ///< r² where it ends
    uint32_t particle;
    int32_t shape;
};

/// The kernels of a cloud that show, in the cloud's own space, whose origin is moved to their
/// middle.
class SplatKernels {
public:
    explicit SplatKernels(std::shared_ptr<const SplatCloud> cloud);

    const SplatCloud& cloud() const { return *_cloud; }
    const dvec3& middle() const { return _middle; }
    const std::vector<SplatKernel>& list() const { return _list; } ///< neighbours near each other
    vec3 boundsMin() const { return _min; }                        ///< of where they end
    vec3 boundsMax() const { return _max; }
    /// Half of the box around a kernel, wide enough that rounding leaves what a ray meets inside.
    vec3 halfOf(const SplatKernel& kernel) const;

    /// Radiance in the cloud's colour space.
    vec3 radiance(uint32_t kernel, const shSplats::SplatBasis& basis) const;

private:
    std::shared_ptr<const SplatCloud> _cloud;
    std::vector<SplatKernel> _list;
    dvec3 _middle{0.0};
    vec3 _min{INFINITY}, _max{-INFINITY};
};

/// Of the radiance of a prim to the rendering space; null where they are the same.
ColorTransformPtr transformOf(const Splats& prim, const RenderingSpace& space,
                              Diagnostics& diagnostics);

/// The kernels of a scene's clouds, made once for all who ask for the same. Thread safe.
class CompiledSplats {
public:
    using CloudPtr = std::shared_ptr<const SplatCloud>;
    std::shared_ptr<const SplatKernels> kernels(const CloudPtr& cloud) {
        return _made.get(cloud.get(), cloud,
                         [&] { return std::make_shared<const SplatKernels>(cloud); });
    }

private:
    struct Key {
        Reference<const SplatCloud> cloud;
        Key(const CloudPtr& of) : cloud(of) {}
        bool isOf(const CloudPtr& other) const { return cloud.is(other); }
    };
    MadeOnce<CloudPtr, Key, SplatKernels> _made;
};

} // namespace patina
