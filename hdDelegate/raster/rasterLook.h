#pragma once

#include "hdDelegate/raster/glProgram.h"
#include "hdDelegate/raster/glResources.h"

#include <memory>
#include <string>

namespace patina {

/// First looks: passes in which pixels find light by other samples than their neighbours, and are
/// smoothed over the surface (shaders/raster/firstLook.frag.glsl). Ordinary passes, which converge,
/// follow: what smoothing has wrong is divided by all of them.
class RasterLook {
public:
    static constexpr int passes = 8;
    static constexpr int reach = 1; ///< pixels on each side; more blurs shadows
    static constexpr int bsdfSamples = 4; ///< per pixel, where domes are

    /// @param error is set where the driver does not take the programs
    explicit RasterLook(std::string& error);
    bool ok() const { return _rows && _columns; }

    /// @returns false when the driver has no room
    bool resize(const GlTexture& color, const GlTexture& depth);
    /// What surfaces are drawn into, in all passes: drivers compile a program anew for other targets.
    const GlFramebuffer& target() const { return _target; }
    void clear() const;
    /// Adds the smoothed light of a first look to what was drawn without it.
    void add(const GlFramebuffer& color) const;

private:
    std::unique_ptr<GlProgram> _rows, _columns;
    GlTexture _noisy, _guide, _place, _normal, _rowLight, _rowGuide;
    GlFramebuffer _target, _rowTarget;
};

} // namespace patina
