// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/raster/scene/rasterVolumes.h"

namespace patina {

/// The background of surfaces that transmit: the picture of all others with its depths, and the
/// far sides of those that transmit. Read by shaders/raster/refraction.glsl.
class RasterRefraction {
public:
    RasterRefraction();

    /// @returns false when the driver has no room
    bool resize(int width, int height);
    /// Clears the far sides, and makes them what is drawn into.
    void beginBacks() const;
    /// Keeps a picture as it is now.
    void keep(const GlTexture& color, const GlTexture& depth);
    void bind() const;
    const GlTexture& depth() const { return _depth; } ///< that is kept
    /// Draws a volume over the picture that is kept. @param index of the volume in the pass
    void drawVolume(const RasterVolume& volume, int index) const;

private:
    std::unique_ptr<GlProgram> _program, _volume = GlProgram::own("background", "volume");
    GlTexture _color, _depth, _backPosition, _backNormal, _backDepth;
    GlFramebuffer _target;
};

} // namespace patina
