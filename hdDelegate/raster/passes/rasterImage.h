// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/filmSource.h"
#include "hdDelegate/raster/gl/hostImage.h"
#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/passes/rasterFilterSplat.h"
#include "hdDelegate/raster/scene/rasterCamera.h"

#include <map>
#include <memory>
#include <vector>

namespace patina {

class GlContext;

/// The image of a viewport: the means of its passes stay on the device, and so do depth and ids,
/// until a listener asks for pixels.
class RasterImage final : public FilmSource {
public:
    /// @param context that all of it is made and used with
    /// @param host that the context shares its objects with, or null
    RasterImage(const GlContext& context, std::shared_ptr<HostContext> host)
        : _context(context), _host(std::move(host)) {}

    /// Begins an image without passes.
    /// @param window of the image that is drawn: xmin, ymin, xmax, ymax, inclusive, y down
    /// @param places, ids that drawAovs() draws
    /// @returns false when the driver has no room
    bool begin(int width, int height, const int window[4], const RasterCamera& camera,
               const GlTexture& places, const GlTexture& ids);
    /// Adds a pass.
    /// @param difference that smoothing makes to it, or null
    /// @param first a first image of many samples, which shows until later passes are better
    /// @param negative the lights take light away
    void add(const GlTexture& color, const GlTexture* difference, const RasterSample& sample,
             bool first, bool negative);

    bool has(AovId aov) const override;
    bool read(AovId aov, const PixelForm& form, void* bytes) const override;
    std::shared_ptr<DeviceImage> draw(AovId aov, const PixelForm& form) const override;

private:
    enum Wanted { Color, Alpha, WindowDepth, AxisDepth, CentreDepth }; ///< see image.frag.glsl
    struct Target {
        GlTexture image;
        GlFramebuffer framebuffer;
        GLenum format = 0;
        bool complete = false;
    };
    const Target& target(GLenum format) const;
    struct HostTarget { ///< an image that a host has, or has had
        std::shared_ptr<HostImage> image;
        GlFramebuffer framebuffer;
    };
    const HostTarget& hostTarget(GLenum format, int components) const;
    bool canDraw(AovId aov, const PixelForm& form) const;
    void drawInto(const GlFramebuffer& framebuffer, AovId aov, const PixelForm& form) const;

    const GlContext& _context;
    std::shared_ptr<HostContext> _host;
    std::unique_ptr<GlProgram> _accumulate = GlProgram::own("background", "accumulate");
    std::unique_ptr<GlProgram> _numbers = GlProgram::own("background", "image");
    std::unique_ptr<GlProgram> _ids = GlProgram::own("background", "image", "#define IDS\n");
    std::unique_ptr<GlProgram> _depths = GlProgram::own("background", "image", "#define DEPTHS\n");
    GlVertexArray _vertexArray;
    int _width = 0, _height = 0;
    int _window[4] = {0, 0, -1, -1}; ///< y up
    GlTexture _sums, _smoothings, _first;
    GlFramebuffer _sumTarget, _firstTarget;
    bool _complete = false, _negative = false, _hasFirst = false;
    uint32_t _passes = 0; ///< that there were; a first image counts
    float _weight = 0.0f; ///< of the passes in _sums
    std::unique_ptr<RasterCamera> _camera;
    const GlTexture *_placesDrawn = nullptr, *_idsDrawn = nullptr;
    mutable GlDownload _download;
    mutable std::map<GLenum, Target> _targets; ///< by format
    mutable std::vector<HostTarget> _hostTargets;
};

} // namespace patina
