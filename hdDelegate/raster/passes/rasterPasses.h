// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/lights/rasterDomes.h"
#include "hdDelegate/raster/passes/rasterBackground.h"
#include "hdDelegate/raster/passes/rasterImage.h"
#include "hdDelegate/raster/passes/previewPasses.h"
#include "hdDelegate/raster/passes/rasterRefraction.h"
#include "hdDelegate/raster/passes/rasterSeen.h"
#include "hdDelegate/raster/shadows/rasterCasters.h"

namespace patina {

/// Draws passes over a scene and hands their pixels to a film. Lives with one context.
class RasterPasses {
public:
    RasterPasses() { gl.GetIntegerv(GL_MAX_TEXTURE_SIZE, &_largest); }

    /// Sets the size of the image, and which of its pixels reach the film.
    /// @param border of the samples, which becomes 0 where the driver has no room for one
    /// @returns false when the driver has no room for the image
    bool resize(const RenderSettings& settings, int& border);
    const int* window() const { return _window; } ///< xmin, ymin, xmax, ymax, inclusive

    /// Begins an image that stays on the device.
    /// @param host whose device it may be handed to, or null
    const FilmSource& beginImage(const GlContext& context, const std::shared_ptr<HostContext>& host,
                                 const RasterCamera& camera);
    const FilmSource* image() const { return _image.get(); } ///< of before, or null

    /// See RasterSeen.
    void drawAovs(const RasterScene& scene, const RasterCamera& camera, bool inSteps) {
        _seen.draw(scene, camera, inSteps);
        _casters.forgetSky();
    }
    RasterSeen& seen() { return _seen; }

    /// One sample of every pixel, for the film or for the image that it has as its source.
    void draw(const RasterScene& scene, const RasterLights& lights, const RasterDomes& domes,
              const RasterCamera& camera, const RasterSample& sample, Film& film);

    /// @param notify is called whenever a program is drawn with for the first time
    void setFirstDraws(std::function<void()> notify) { _surfaces.firstDraws = std::move(notify); }

    /// Draws what earlier passes have left for later ones, for a film that holds `taken` of them.
    /// @param moveTo brings the scene to the shutter time of a pass
    /// @param from the first pass that was not drawn again
    void resumeAt(const RasterScene& scene, const RasterLights& lights, uint32_t from,
                  uint32_t taken, const std::function<void(uint32_t)>& moveTo);
    /// Passes that have to be drawn again to continue a film of `taken`.
    static uint32_t passesToRepeat(uint32_t taken) {
        return taken < PreviewPasses::smoothed ? taken : 0;
    }

    GlTimer& timer() { return _surfaces.timer; } ///< of all that was drawn

    static constexpr int shadowMapSize = 1024;
    static constexpr int bsdfSamples = 2; ///< per pixel and pass

private:
    /// @returns false where nothing does
    bool drawTransmitting(const RasterScene& scene, const RasterVisible& visible,
                          const RasterLightFilters& filters);
    void drawSplats(const RasterScene& scene, bool beforeGlass);
    void drawVolumes(const RasterScene& scene);
    void needRefraction();
    void drawImage(const RasterScene& scene, const RasterLights& lights, const RasterDomes& domes,
                   const RasterCamera& camera, const RasterSample& sample,
                   const SampledLights& sampled, bool preview);

    RasterSurfaces _surfaces;
    RasterBackground _background;
    RasterCasters _casters{_surfaces.vertexArray()};
    PreviewPasses _preview;
    RasterSplatting _splatting;
    RasterSeen _seen{_surfaces, _splatting};
    RasterManyLights _manyLights;
    std::unique_ptr<RasterImage> _image;           ///< made when a listener wants images alone
    std::unique_ptr<RasterRefraction> _refraction; ///< made when something transmits
    GLint _largest = 0;                            ///< pixels along a side of a texture
    int _width = 0, _height = 0, _border = 0;
    int _window[4] = {0, 0, -1, -1};
    GlTexture _color, _depth;
    GlFramebuffer _colorTarget, _pictureTarget; ///< with depths and without
};

} // namespace patina
