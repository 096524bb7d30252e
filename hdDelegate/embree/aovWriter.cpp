// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/aovWriter.h"

#include "hdDelegate/compiled/matteNames.h"
#include "hdDelegate/embree/hitPlace.h"
#include "hdDelegate/film/aovValues.h"

namespace patina {

namespace {

/// For aovValue().
class HitPoint {
public:
    static constexpr bool denoisingOfPaths = true;

    HitPoint(const CameraRays& camera, const SurfacePoint& point, const Bsdf& bsdf)
        : _camera(camera), _shading(point.shading), _hit(*point.hit), _bsdf(bsdf),
          _inCamera(vec3(camera.worldToCamera() * vec4(point.shading.position, 1.0f))) {}

    const vec3& inCamera() const { return _inCamera; }
    float depth() const { return _camera.depthOf(_inCamera); }
    float windowDepth() const { return _camera.windowDepth(_inCamera); }
    vec3 position() const { return _shading.worldPosition(); }
    const vec3& normal() const { return _shading.normal; }
    const vec3& geometricNormal() const { return _shading.geometricNormal; }
    const mat4& worldToCamera() const { return _camera.worldToCamera(); }
    int primId() const { return _hit.surface->primId; }
    int instanceId() const { return _hit.instanceId; }
    int elementId() const { return _hit.surface->element(_hit.primitive); }
    bool albedo(float out[4]) const {
        const vec3 a = _bsdf.albedo();
        out[0] = a.x, out[1] = a.y, out[2] = a.z;
        return true;
    }
    /// A surface without it has zeros.
    bool primvar(float out[4]) const {
        readPrimvar(_hit, *primvarName, out);
        return true;
    }
    bool reference(float out[4]) const {
        if (readPrimvar(_hit, *primvarName, out)) return true;
        const dvec3 place = _hit.surface->shape == Surface::Shape::Triangles
                                ? HitPlace(_hit, _camera.frame()).inPrim()
                                : dvec3(_shading.objectPosition);
        out[0] = float(place.x), out[1] = float(place.y), out[2] = float(place.z);
        return true;
    }
    bool motion(bool later, float out[4]) const {
        const HitPlace place(_hit, _camera.frame());
        const auto moment = later ? ScreenMotion::After : ScreenMotion::Before;
        return _camera.motion().way(place.inWorld(ScreenMotion::Now), place.inWorld(moment), moment,
                                    out);
    }

    const std::string* primvarName = nullptr;

private:
    const CameraRays& _camera;
    const ShadingPoint& _shading;
    const Hit& _hit;
    const Bsdf& _bsdf;
    vec3 _inCamera;
};

/// For the AOVs of Cryptomatte.
std::string matteOf(AovId id, const SurfacePoint& point) {
    const Hit& hit = *point.hit;
    const Geometry& prim = *hit.surface->prim;
    if (id == AovId::cryptoMaterial)
        return materialMatte(prim, size_t(point.slot - hit.surface->materials.data()));
    return id == AovId::cryptoAsset ? assetMatte(prim, hit.steps, hit.stepCount)
                                    : objectMatte(prim, hit.steps, hit.stepCount);
}

} // namespace

void writeAovs(const std::vector<AovSpec>& aovs, const AovTarget& target, const CameraRays& camera,
               const SurfacePoint& point, const Bsdf& bsdf) {
    HitPoint hit(camera, point, bsdf);
    for (size_t i = 0; i < aovs.size(); ++i) {
        if (aovs[i].kind == AovKind::Coverage) {
            target.film.addCoverage(int(i), target.x, target.y, matteOf(aovs[i].id, point));
            continue;
        }
        float out[4] = {0, 0, 0, 0};
        hit.primvarName = &aovs[i].primvar;
        if (aovValue(aovs[i].id, hit, out))
            target.film.addAov(int(i), target.x, target.y, out, target.distance);
    }
}

void writeScreenAovs(const std::vector<AovSpec>& aovs, const AovTarget& target,
                     const CameraRays& camera, const vec3& position, const vec3& origin,
                     int primId) {
    const vec3 inCamera = vec3(camera.worldToCamera() * vec4(position, 1.0f));
    for (size_t i = 0; i < aovs.size(); ++i) {
        float out[4] = {0, 0, 0, 0};
        switch (aovs[i].id) {
        case AovId::depth: out[0] = camera.depthOf(inCamera); break;
        case AovId::cameraDepth: out[0] = glm::length(inCamera); break;
        case AovId::deviceDepth: out[0] = camera.windowDepth(inCamera); break;
        case AovId::position:
            for (int c = 0; c < 3; ++c)
                out[c] = position[c] + origin[c];
            break;
        case AovId::primId: out[0] = glm::intBitsToFloat(primId); break;
        default: continue;
        }
        target.film.addAov(int(i), target.x, target.y, out, target.distance);
    }
}

} // namespace patina
