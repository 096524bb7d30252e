// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/film/film.h"

#include <algorithm>

namespace patina {

/// Whether aovValue() asks for the normal.
inline bool aovIsOfNormal(AovId id) {
    return id == AovId::normal || id == AovId::Neye || id == AovId::denoisingNormal;
}

/// The value of an AOV at a surface, in one place for all renderers.
///
/// @tparam Point what the renderer knows of the place: inCamera(), its position in camera space,
///         with its depth() and windowDepth(); position() in the world, normal(),
///         geometricNormal(), worldToCamera(), primId(), instanceId(), elementId(); albedo(out),
///         primvar(out), reference(out) and motion(later, out), which say whether they know it; and
///         denoisingOfPaths, where guides of the denoiser come from whole paths
/// @returns false where there is nothing to write
template <class Point> bool aovValue(AovId id, const Point& p, float out[4]) {
    const auto put = [&](const glm::vec3& v) {
        out[0] = v.x, out[1] = v.y, out[2] = v.z;
        return true;
    };
    const auto putId = [&](int value) {
        out[0] = glm::intBitsToFloat(value);
        return true;
    };
    switch (id) {
    case AovId::depth: out[0] = p.depth(); return true;
    case AovId::cameraDepth: out[0] = glm::length(p.inCamera()); return true;
    case AovId::deviceDepth: out[0] = p.windowDepth(); return true;
    case AovId::normal: return put(p.normal());
    case AovId::Neye: {
        const glm::vec3 n = glm::mat3(p.worldToCamera()) * p.normal();
        return put(n / std::max(1e-30f, glm::length(n)));
    }
    case AovId::Ng: return put(p.geometricNormal());
    case AovId::position: return put(p.position());
    case AovId::uv: return p.primvar(out);
    case AovId::Pref: return p.reference(out);
    case AovId::motionForward: return p.motion(true, out);
    case AovId::motionBackward: return p.motion(false, out);
    case AovId::albedo: return p.albedo(out);
    case AovId::denoisingAlbedo: return !Point::denoisingOfPaths && p.albedo(out);
    case AovId::denoisingNormal: return !Point::denoisingOfPaths && put(p.normal());
    case AovId::denoisingHalfColor:
    case AovId::denoisingHalfAlbedo:
    case AovId::denoisingHalfNormal:
    case AovId::quarterColors:
    case AovId::quarterShares: return false; // of paths alone
    case AovId::primvars: return p.primvar(out);
    case AovId::primId: return putId(p.primId());
    case AovId::instanceId: return putId(p.instanceId());
    case AovId::elementId: return putId(p.elementId());
    case AovId::cryptoObject: // see addCoverage()
    case AovId::cryptoMaterial:
    case AovId::cryptoAsset:
    case AovId::color:
    case AovId::alpha:
    case AovId::lpe:
    case AovId::emission:
    case AovId::diffuse:
    case AovId::specular:
    case AovId::transmission:
    case AovId::subsurface:
    case AovId::volume:
    case AovId::direct:
    case AovId::indirect:
    case AovId::shadow:
    case AovId::sampleCount:
    case AovId::variance:
    case AovId::unknown: return false;
    }
    return false;
}

} // namespace patina
