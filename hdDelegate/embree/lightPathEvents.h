// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/embree/lightPathRecord.h"
#include "hdDelegate/embree/path.h"
#include "hdDelegate/embree/sceneLights.h"

namespace patina {

/// Tells the record of a path who gives light. Only for paths that have a record.
class LightPathEvents {
public:
    LightPathEvents(const SceneLights& lights, const LightPathAovs& aovs)
        : _lights(lights), _aovs(aovs) {}

    LightEvent emitter(int light) const;
    /// A surface that was hit gives off light.
    void emission(const Path& path, const Hit& hit) const;
    /// A light sample arrives at a surface.
    /// @param incident radiance over density, with its weight and what is left of it
    void direct(const Path& path, const ShadingPoint& s, const LightSample& light,
                const BsdfEval& f, const vec3& incident) const;
    /// For the AOV of shadows: what a light sample lacks.
    /// @param value of the lobes; @param seen share of the light that arrives
    void shadow(const Path& path, const vec3& value, const LightSample& light, const vec3& radiance,
                const vec3& seen) const;

private:
    LightEvent glow(const Surface& surface) const;

    const SceneLights& _lights;
    const LightPathAovs& _aovs;
};

} // namespace patina
