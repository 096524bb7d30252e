// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/passes/rasterFilterSplat.h"
#include "hdDelegate/raster/passes/rasterMattes.h"
#include "hdDelegate/raster/passes/rasterSplatting.h"
#include "hdDelegate/raster/passes/rasterSurfaces.h"
#include "hdDelegate/raster/shadows/rasterShadows.h"

namespace patina {

/// By pixel, rows from the bottom as OpenGL counts.
struct RasterSeenImages {
    std::vector<vec4> positions; ///< world space beside the origin, w 0 where nothing is
    std::vector<vec4> normals, geometricNormals, albedos;
    std::vector<std::vector<vec4>> primvars;
    std::vector<int> ids; ///< prim, instance, element, place of the prim
};

/// What the camera sees through the pixels' centres: ids, positions and normals, what else the AOVs
/// need, and what follows from where it is. Lives with one context.
class RasterSeen {
public:
    /// @param surfaces, splatting that it is drawn with
    RasterSeen(RasterSurfaces& surfaces, RasterSplatting& splatting)
        : _surfaces(surfaces), _splatting(splatting) {}

    /// @param depth that is drawn into, besides
    /// @returns false when the driver has no room
    bool resize(int width, int height, const GlTexture& depth);
    /// @param inSteps bounds() may be wider, so that small moves of the camera leave them as they
    /// are
    void draw(const RasterScene& scene, const RasterCamera& camera, bool inSteps);
    /// Writes it to the film's AOVs, but for those of its source.
    /// @param window pixels of the film: xmin, ymin, xmax, ymax, inclusive
    void write(const RasterScene& scene, const RasterCamera& camera, const int* window, Film& film);
    /// Draws a sample of every pixel, and counts what it sees for the AOVs of Cryptomatte.
    void count(const RasterScene& scene, const RasterMattes& mattes, const RasterCamera& camera,
               const RasterSample& sample, uint32_t seed, const int* window, Film& film);

    /// Where the scene's origin should be: 0, unless that is far from what is seen beside its size.
    /// The same for small moves of the camera.
    vec3 originOf(const RasterScene& scene) const;
    const ShadowBounds& bounds() const { return _bounds; } ///< with what is seen as receivers
    const GlTexture& positions() const { return _position; }
    const GlTexture& ids() const { return _ids; }

private:
    void makeTarget(const RasterAovRequest& request);
    void fillTarget(const RasterScene& scene, const RasterView& view, const RasterPassBlock& block);
    void drawSplats(const RasterScene& scene, const RasterView& view);
    void readIds(std::vector<int>& ids);
    void measureReceivers(const RasterScene& scene, const RasterCamera& camera, bool inSteps);

    RasterSurfaces& _surfaces;
    RasterSplatting& _splatting;
    std::unique_ptr<GlProgram> _receivers = GlProgram::own(
        {{GL_COMPUTE_SHADER, "receivers", "#include \"shaders/raster/receivers.comp.glsl\"\n"}});
    int _width = 0, _height = 0;
    const GlTexture* _depth = nullptr;
    GlTexture _position, _normal, _ids, _albedo, _geometricNormal;
    std::vector<GlTexture> _primvars;
    GlFramebuffer _target, _splatTarget; ///< with depths and without
    int _others = 0;                     ///< targets after the first three
    RasterAovRequest _request;           ///< that _target is for
    bool _complete = false;
    RasterSeenImages _images; ///< of write()
    ShadowBounds _bounds;
    vec3 _seenMin{0.0f}, _seenMax{0.0f};
};

} // namespace patina
