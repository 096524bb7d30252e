// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/messages.h"
#include "hdDelegate/compiled/placements.h"

#include <map>
#include <optional>

namespace patina {

/// One place where the prims of a group are drawn.
struct RasterPlace {
    dmat4 groupToWorld{1.0}; ///< all digits: the origin may be taken from large numbers
    int id = -1;             ///< for the instanceId AOV
    bool matte = false;
    std::vector<std::string> categories;
    std::vector<InstanceStep> steps; ///< from the outermost instance inwards
};

/// Where groups are drawn: instancers, nested ones too, made flat.
class RasterInstances {
public:
    /// @param origin of the space that is called the world here, in the scene's world
    RasterInstances(std::shared_ptr<const Placements> placements, float timeCode,
                    const vec3& origin = vec3(0.0f));
    /// The world has one place.
    const std::vector<RasterPlace>& places(const std::string& group);

private:
    std::shared_ptr<const Placements> _placements;
    std::map<std::string, std::vector<RasterPlace>> _places;
    float _time;
    vec3 _origin;
};

/// Whether a prim is drawn, and cameras see it.
bool isDrawnInRaster(const Geometry& prim, const RenderSettings& settings);

/// A warning that names the parts of visibility and catching which the rasterizer lacks; null for
/// nothing.
std::optional<Message> notShownInRaster(const Marked& prim);

} // namespace patina
