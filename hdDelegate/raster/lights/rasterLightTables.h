// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/lights/distribution2d.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/scene/light.h"

#include <map>

namespace patina {

/// An image on a rect light with the density that its samples are drawn with.
struct RectImage {
    int first = 0, width = 0, height = 0; ///< in the buffer: rgb, w density relative to uniform
    float mean = 0.0f;                    ///< of all texels and channels
    std::shared_ptr<const ImageRGB> image;
    Distribution2d distribution;

    /// @param q receives the position in the unit shape's coordinates
    /// @returns the density relative to uniform
    float sample(const vec2& u, vec2& q) const;
    /// Radiance factor at a position of the unit shape, as LightEmitter has it.
    vec3 radiance(const vec2& q) const;
};

/// A profile as a ProfileGrid in the buffer.
struct ProfileTable {
    int first = -1, thetas = 0, phis = 0;
    float largest = 1.0f; ///< value; 1 without a profile
};

/// Tables of lights that shaders look up in one buffer: images of rects, profiles, harmonics of
/// domes.
class RasterLightTables {
public:
    static constexpr int largestImage = 512; ///< texels along a side; larger ones are averaged
    /// Values of all lights: lights tell places of their filters by 23 bits.
    static constexpr size_t maxValues = (size_t(1) << 23) - 2;

    /// The image of a rect light, once for all lights that show it. @returns null when there is
    /// none, or, with a warning, no room for it
    const RectImage* rect(const Light& light, LightImages& images, Diagnostics& diagnostics);
    /// The IES profile of a light, scaled as the light wants it; once for all places of the light.
    /// Without room, with a warning, the light is not shaped by it.
    ProfileTable profile(const Light& light, Diagnostics& diagnostics);
    /// Values of any kind. @returns the place of the first; -1: there is no room
    int add(const std::vector<vec4>& values);
    /// Whether so many more values have room.
    bool hasRoom(size_t values) const { return _values.size() + values <= maxValues; }

    /// Makes the buffer of all that was added.
    /// @param room for values of a pass behind them
    void upload(int room = 0);
    /// Where the values of a pass begin.
    int firstOfPass() const { return _firstOfPass; }
    /// Replaces them; those beyond the room are left out.
    void writePass(const std::vector<vec4>& values) const;
    const GlBuffer& buffer() const { return _buffer; }

private:
    std::vector<vec4> _values;
    std::vector<std::unique_ptr<RectImage>> _rects;
    std::map<const Light*, ProfileTable> _profiles;
    mutable GlBuffer _buffer; ///< of which passes write the end
    int _firstOfPass = 0, _room = 0;
};

} // namespace patina
