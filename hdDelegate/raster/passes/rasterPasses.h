// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"
#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/gl/glTimer.h"
#include "hdDelegate/raster/lights/rasterLights.h"
#include "hdDelegate/raster/lights/rasterManyLights.h"
#include "hdDelegate/raster/lights/rasterSky.h"
#include "hdDelegate/raster/passes/rasterAovs.h"
#include "hdDelegate/raster/passes/rasterBackground.h"
#include "hdDelegate/raster/passes/rasterFilterSplat.h"
#include "hdDelegate/raster/passes/rasterImage.h"
#include "hdDelegate/raster/passes/rasterLook.h"
#include "hdDelegate/raster/passes/rasterMattes.h"
#include "hdDelegate/raster/passes/rasterRefraction.h"
#include "hdDelegate/raster/scene/rasterScene.h"

#include <functional>

namespace patina {

/// Draws passes over a scene and hands their pixels to a film. Lives with one context.
class RasterPasses {
public:
    /// @param error is set, and ok() false, when the driver does not take what every pass needs
    explicit RasterPasses(std::string& error);
    bool ok() const {
        return _background && _background->ok() && _shadow && _shadowAround && _depthOnly &&
               _receivers && _look && _look->ok();
    }

    /// Sets the size of the image, and which of its pixels reach the film.
    /// @param border of the samples, which becomes 0 where the driver has no room for one
    /// @returns false when the driver has no room for the image
    bool resize(const RenderSettings& settings, int& border);
    const int* window() const { return _window; } ///< xmin, ymin, xmax, ymax, inclusive

    /// Begins an image that stays on the device.
    const FilmSource& beginImage(const EglContext& context, const RasterCamera& camera);
    const FilmSource* image() const { return _image.get(); } ///< of before, or null

    /// Ids and positions through the pixels' centres, and what else the AOVs need.
    /// @param inSteps shadow maps may have some larger texels, so that small moves of the camera
    ///        leave them as they are
    void drawAovs(const RasterScene& scene, const RasterCamera& camera, bool inSteps);
    /// Writes them to the film's AOVs, but for those of its source.
    void writeAovs(const RasterScene& scene, const RasterCamera& camera, Film& film);
    /// Counts what a sample of every pixel sees, for the AOVs of Cryptomatte.
    void drawMattes(const RasterScene& scene, const RasterMattes& mattes,
                    const RasterCamera& camera, const RasterSample& sample, uint32_t seed,
                    Film& film);
    /// Where the scene's origin should be for what drawAovs() has seen: 0, unless that is far from
    /// it beside its size. The same for small moves of the camera.
    vec3 originOfSeen(const RasterScene& scene) const;

    /// One sample of every pixel, for the film or for the image that it has as its source.
    /// @param environmentSamples of domes per pixel, where they are filtered
    void draw(const RasterScene& scene, const RasterLights& lights, const RasterDomes& domes,
              int environmentSamples, const RasterCamera& camera, const RasterSample& sample,
              Film& film);

    /// @param notify is called whenever a program is drawn with for the first time
    void setFirstDraws(std::function<void()> notify) { _firstDraws = std::move(notify); }

    /// Draws what earlier passes have left for later ones, for a film that holds `taken` of them.
    /// @param moveTo brings the scene to the shutter time of a pass
    /// @param from the first pass that was not drawn again
    void resumeAt(const RasterScene& scene, const RasterLights& lights, uint32_t from,
                  uint32_t taken, const std::function<void(uint32_t)>& moveTo);
    /// Passes that have to be drawn again to continue a film of `taken`.
    static uint32_t passesToRepeat(uint32_t taken) {
        return taken < RasterLook::smoothed ? taken : 0;
    }

    /// The driver's seconds by kind of work, of all that was drawn since clearSeconds().
    enum Share { Aovs, Shadows, Surfaces, ReadBack, ShareCount };
    double seconds(Share share) const { return _seconds[share]; }
    void clearSeconds() { _seconds.assign(ShareCount, 0.0); }

    static constexpr int shadowMapSize = 1024;
    static constexpr int bsdfSamples = 2; ///< per pixel and pass
    static constexpr int maxPlanes = 8;   ///< that a camera clips with; see passBlock.glsl

private:
    struct PassBlock;
    class Clipping;
    void makeAovTarget(const RasterAovRequest& request);
    void fillAovTarget(const RasterScene& scene, const RasterView& view, const PassBlock& b);
    void readIds(std::vector<int>& ids);
    void readColor(std::vector<vec4>& pixels);
    PassBlock block(const RasterScene& scene, const RasterView& view) const;
    /// What each layer of an array of shadow maps shows. The first pass after a camera move, as a
    /// rule, finds what it needs.
    struct ShownShadows {
        struct Layer {
            ShadowView view;
            uint32_t pass;    ///< random numbers of casters that let some light pass follow from it
            uint64_t version; ///< RasterScene::shadowVersion(); 0: nothing is known
        };
        GLuint maps = 0; ///< the array
        std::vector<Layer> layers;
    };
    void drawShadows(const RasterScene& scene, const std::vector<ShadowView>& views, int size,
                     uint32_t pass);
    static int skyCells(const RasterScene& scene);
    static int mostMaps(const RasterScene& scene);
    void drawSky(const RasterScene& scene, const RasterLights& lights, uint32_t pass);
    /// Draws them into a layer, unless that is what it shows.
    /// @param slopes null: only depths are wanted
    void drawCasters(const RasterScene& scene, const ShadowView& view, uint32_t pass,
                     const GlTexture& maps, int layer, ShownShadows& shown,
                     const GlTexture* slopes = nullptr);
    enum Which { AllForAovs, Solid, Transmitting, ColoredPresence };
    /// @param filters of mesh lights; null where nothing is lit
    void drawSurfaces(const RasterScene& scene, const RasterVisible& visible, Which which,
                      const RasterLightFilters* filters = nullptr) const;
    void drawDepths(const RasterScene& scene, const RasterVisible& visible) const;
    void drawTransmitting(const RasterScene& scene, const RasterVisible& visible,
                          const RasterLightFilters& filters);
    void drawVolumes(const RasterScene& scene);
    void needRefraction();
    void drawImage(const RasterScene& scene, const RasterLights& lights, const RasterDomes& domes,
                   int environmentSamples, const RasterCamera& camera, const RasterSample& sample,
                   const RasterLights::Sampled& sampled, bool look);
    void smooth(const RasterSample& sample, bool look, std::vector<vec4>& pixels, Film& film);
    void beginFirst(std::vector<vec4>& pixels, const RasterSample& sample, Film& film);
    void showFirst(std::vector<vec4>& pixels, const RasterSample& sample, Film& film);
    void measureReceivers(const RasterScene& scene, const RasterCamera& camera, bool inSteps);

    std::unique_ptr<GlProgram> _shadow, _shadowAround, _depthOnly, _receivers;
    std::unique_ptr<RasterImage> _image; ///< made when a listener wants images alone
    std::unique_ptr<RasterBackground> _background;
    std::unique_ptr<RasterLook> _look;
    std::unique_ptr<RasterRefraction> _refraction; ///< made when something transmits
    GlBuffer _passBuffer, _albedoTable;
    GlDownload _download;
    GLuint _vertexArray = 0;
    GLint _largest = 0; ///< pixels along a side of a texture
    int _width = 0, _height = 0, _border = 0;
    int _window[4] = {0, 0, -1, -1};
    GlTexture _color, _depth, _position, _normal, _ids, _shadowMaps, _shadowSlopes;
    GlTexture _albedo;
    std::vector<GlTexture> _primvars;
    GlFramebuffer _colorTarget, _aovTarget;
    RasterAovRequest _aovRequest; ///< that _aovTarget is for
    bool _aovsComplete = false;
    GLuint _shadowTarget = 0;
    int _shadowLayers = 0;
    ShownShadows _shownShadows, _shownSky;
    RasterSky _sky;
    RasterManyLights _manyLights;
    std::vector<vec4> _first, _sums; ///< see showFirst(); of the film's pixels
    std::vector<vec4> _smoothing;    ///< what it does to the sums of the film's pixels
    ShadowBounds _bounds;
    RasterAovImages _seen; ///< of writeAovs()
    vec3 _seenMin{0.0f}, _seenMax{0.0f};
    std::function<void()> _firstDraws;
    GlTimer _timer;
    std::vector<double> _seconds = std::vector<double>(ShareCount, 0.0);

public:
    ~RasterPasses();
};

} // namespace patina
