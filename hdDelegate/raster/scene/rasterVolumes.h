// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/compiled/compiledVolumes.h"
#include "hdDelegate/raster/gl/glResources.h"
#include "hdDelegate/scene/scene.h"
#include "hdDelegate/scene/settings.h"

#include <map>
#include <memory>

namespace patina {

/// The medium of a volume prim in textures of at most 64 texels along a side, each the medium at
/// its place; coefficients per scene unit. See shaders/raster/volume.frag.glsl.
struct RasterVolume {
    struct Textures {
        GlTexture scattering, extinction, emission;
    };
    std::shared_ptr<const Textures> textures; ///< those of all places of a prim
    vec3 boundsMin{0.0f}, boundsMax{0.0f};    ///< object space
    mat4 worldToObject{1.0f};

    void bind() const; ///< units 0 to 2
};

/// The volume prims of a scene.
class RasterVolumes {
public:
    RasterVolumes(CompiledVolumes& compiled, Diagnostics& diagnostics)
        : _diagnostics(diagnostics), _compiled(compiled) {}

    static constexpr size_t maxPlaced = 4096; ///< each is drawn over the image on its own

    /// Begins an update; what add() does not name again is forgotten by end().
    void begin() { _placed.clear(); }
    /// @param toWorld of every place of the prim
    /// @param minimum, maximum are widened by its bounds
    void add(const std::shared_ptr<const Volume>& prim, const SceneState& state,
             const RenderSettings& settings, const std::vector<mat4>& toWorld, vec3& minimum,
             vec3& maximum);
    void end();
    /// Lets go of the media, which are in textures, once other back ends have had time to take them
    /// over.
    void release();

    const std::vector<const RasterVolume*>& placed() const { return _placed; }

private:
    struct Cached {
        std::shared_ptr<const Volume> prim;
        std::shared_ptr<const MaterialPrim> material;
        MethodChoices methods;
        std::shared_ptr<const VolumeMedium> medium; ///< until release()
        std::vector<mat4> places;
        std::vector<RasterVolume> volumes; ///< per place
        bool used = false;
    };
    void build(Cached& cached);

    Diagnostics& _diagnostics;
    CompiledVolumes& _compiled;
    std::map<std::string, Cached> _cache; ///< by path
    std::vector<const RasterVolume*> _placed;
};

} // namespace patina
