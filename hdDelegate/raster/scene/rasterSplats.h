// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/splatKernels.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/scene/rasterInstances.h"

#include <map>
#include <memory>

namespace patina {

/// A cloud where it is drawn. Its space has its middle as the origin.
struct RasterSplatPlace {
    std::shared_ptr<const SplatKernels> kernels;
    mat4 toWorld{1.0f}, toLocal{1.0f}; ///< world beside the origin
    uint32_t firstKernel = 0;          ///< in the buffer of all kernels
};

/// The splats of a scene in buffers that shaders/raster/splats.frag.glsl reads.
class RasterSplats {
public:
    RasterSplats(CompiledSplats& compiled, Diagnostics& diagnostics)
        : _diagnostics(diagnostics), _compiled(compiled) {}

    /// Begins an update; what add() does not name again is forgotten by end().
    void begin() { _prims.clear(); }
    /// @param id for the AOV primId
    void add(const std::shared_ptr<const Splats>& prim, int id, const RenderingSpace& space) {
        _prims.push_back({prim, id, transformOf(*prim, space, _diagnostics), {}});
    }
    void end();
    /// Places them as at a time of the shutter.
    void moveTo(RasterInstances& places, float timeCode);

    bool empty() const { return _placed.empty(); }
    const std::vector<RasterSplatPlace>& placed() const { return _placed; }
    void bind() const;           ///< storage 0, 1, 2 and 12
    static size_t mostEntries(); ///< of a list of kernels that the driver has room for

    vec3 boundsMin() const { return _min; } ///< at the time of the last moveTo()
    vec3 boundsMax() const { return _max; }

private:
    struct Cloud {
        std::shared_ptr<const SplatKernels> kernels;
        uint32_t firstKernel = 0;
        int firstCoefficient = -1, coefficients = 0; ///< floats from the first; of a particle
    };
    struct Prim {
        std::shared_ptr<const Splats> prim;
        int id = 0;
        ColorTransformPtr toRendering; ///< null: the radiance is of the rendering space
        Cloud cloud;
        int table = -1; ///< first row of its colours
    };
    void addTable(Prim& prim, std::vector<vec4>& rows) const;

    Diagnostics& _diagnostics;
    CompiledSplats& _compiled;
    std::vector<Prim> _prims;
    std::map<std::shared_ptr<const SplatCloud>, Cloud> _clouds; ///< in the buffers
    std::vector<RasterSplatPlace> _placed;
    GlBuffer _kernelBuffer, _harmonicBuffer, _placeBuffer, _tableBuffer;
    vec3 _min{INFINITY}, _max{-INFINITY};
};

} // namespace patina
