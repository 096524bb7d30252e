// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/splatsAlong.h"

#include "hdDelegate/embree/lightPathRecord.h"
#include "hdDelegate/embree/media/freeFlight.h"
#include "hdDelegate/embree/vertex.h"

#include <cmath>

namespace patina {

namespace {

/// What they shine. @param left of the light, up to `way`
vec3 splatsAlong(const EmbreeScene& scene, Path& path, float end, float way, float& left) {
    const SplatScene& splats = scene.splats();
    const SplatScene::Ray ray{path.origin, path.direction, path.near, end, path.time, path.rays};
    const bool camera = path.fromCamera(), inMedium = !path.media.empty();
    SplatScene::Look look(splats, ray);
    vec3 shines(0.0f);
    float leftAtWay = -1.0f, seen = 0.0f;
    left = 1.0f;
    // Volumes are asked for what they let through up to one kernel, which stands for all.
    const bool inVolumes = !scene.volumes().empty();
    vec3 chosen(0.0f);
    float chosenAt = 0.0f, chosenWeight = 0.0f, weights = 0.0f;
    splats.along(ray, [&](const SplatHit& hit) {
        if (leftAtWay < 0.0f && hit.distance > way) leftAtWay = left;
        const float share = left * hit.alpha;
        left *= 1.0f - hit.alpha;
        if (!(camera && splats.isMatte(hit))) {
            seen += share;
            vec3 light = share * look.radiance(hit);
            if (inMedium) light *= transmittance(path.media.extinction(), hit.distance);
            shines += light;
            const float weight = std::abs(light.x) + std::abs(light.y) + std::abs(light.z);
            weights += weight;
            if (inVolumes && path.sampler.random() * weights < weight) {
                chosen = light;
                chosenAt = hit.distance;
                chosenWeight = weight;
            }
        }
        if (left < 0.5f && camera && !path.shown) {
            path.shown = true;
            path.screen = splats.primId(hit);
            path.screenPosition = path.origin + path.direction * hit.distance;
        }
        if (left < shSplats::SPLAT_END) left = 0.0f;
        return left > 0.0f;
    });
    if (inVolumes && chosenWeight > 0.0f)
        shines = chosen * (weights / chosenWeight) *
                 scene.volumes().transmittance(path.origin, path.direction, chosenAt, path.rays,
                                               path.sampler);
    if (camera) path.alpha += (1.0f - path.alpha) * seen;
    path.alpha += path.caught * seen;
    path.caught *= left;
    if (leftAtWay >= 0.0f) left = leftAtWay;
    return shines;
}

} // namespace

float passSplats(const EmbreeScene& scene, Path& path, float end, float way) {
    float left = 1.0f;
    vec3 shines = splatsAlong(scene, path, end, way, left);
    if (shines == vec3(0.0f)) return left;
    if (path.splatsSampled)
        shines *= misWeight(
            path.pdf, scene.splats().lights().pdf(path.vertex, path.vertexNormal, path.direction),
            false);
    if (path.lightPaths) path.lightPaths->straight(LightEvent());
    path.add(shines);
    // They are their own texture.
    if (!path.featured) path.featureAlbedo += glm::clamp(path.throughput * shines, 0.0f, 1.0f);
    return left;
}

vec3 sampleSplats(const EmbreeScene& scene, Path& path, const SurfacePoint& point,
                  const VertexBsdf& bsdf, TraceCounters& counters) {
    const ShadingPoint& s = point.shading;
    const vec3 u(path.sampler.next4());
    const SplatLights::Direction drawn =
        scene.splats().lights().sample(s.position, facingNormal(s), u);
    if (!(drawn.pdf > 0.0f) || !staysOutside(point, drawn.direction)) return vec3(0.0f);
    const BsdfEval f = bsdf.eval(drawn.direction);
    const vec3 value = f.diffuse + f.specular;
    if (value == vec3(0.0f)) return value;
    Path there(path);
    there.lightPaths = nullptr;
    there.deep = nullptr;
    ++there.depth;
    there.rays = RayDiffuse;
    there.origin = point.departure(drawn.direction);
    there.direction = drawn.direction;
    there.near = 0.0f;
    ++counters.rays;
    Hit hit;
    const bool found =
        scene.intersect(there.origin, there.direction, 0.0f, INFINITY, there.time, there.rays, hit);
    float left;
    const float end = found ? hit.distance : INFINITY;
    const vec3 incident = splatsAlong(scene, there, end, end, left) *
                          (misWeight(drawn.pdf, f.pdf * float(path.branches), false) / drawn.pdf);
    path.sampler = there.sampler;
    if (path.lightPaths)
        path.lightPaths->lit(EventType::Reflect, f.diffuse * incident, f.specular * incident,
                             LightEvent());
    return value * incident;
}

} // namespace patina
