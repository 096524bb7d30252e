// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/path.h"

#include "hdDelegate/embree/lightPathRecord.h"
#include "base/maths.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float rouletteBelow = 0.25f; // of the throughput that a path had at the camera
constexpr int endlessDepth = 16;       // surfaces, beyond which nearly white rooms end paths too

void recordScatter(LightPathRecord& record, const BsdfSample& next, const VertexBsdf& bsdf) {
    const EventType type =
        (next.event & sh::LOBE_TRANSMIT) != 0 ? EventType::Transmit : EventType::Reflect;
    const bool singular = (next.event & sh::LOBE_DELTA) != 0;
    vec3 share(next.diffuse ? 1.0f : 0.0f);
    if (!singular) {
        const BsdfEval f = bsdf.evalDrawn(next);
        const vec3 sum = f.diffuse + f.specular;
        for (int c = 0; c < 3; ++c)
            if (sum[c] > 0.0f) share[c] = f.diffuse[c] / sum[c];
    }
    record.scatter(type, singular, share);
}

} // namespace

void Path::add(const vec3& light) {
    vec3 contribution = throughput * light;
    float clamp = 1.0f;
    if (indirectClamp > 0.0f && indirect()) {
        const float l = std::abs(luminance(contribution));
        if (l > indirectClamp * share) contribution *= clamp = indirectClamp * share / l;
    }
    radiance += contribution;
    if (lightPaths) lightPaths->add(light, throughput * clamp);
}

void Path::pass(const SurfacePoint& point) {
    origin = point.shading.position + direction * std::max(point.offset, 1e-7f);
    near = 0.0f;
    splatsSampled = false;
}

void Path::depart(const SurfacePoint& point, const Hit& hit, const VertexBsdf& bsdf,
                  const BsdfSample& next, bool splitsLobes) {
    const ShadingPoint& s = point.shading;
    const bool back = glm::dot(s.geometricNormal, s.viewDirection) < 0.0f;
    rays = (next.event & sh::LOBE_TRANSMIT) != 0 ? RayTransmission
           : next.diffuse                        ? RayDiffuse
                                                 : RaySpecular;
    specular = (next.event & sh::LOBE_DELTA) != 0;
    splatsSampled = false;
    pdf = next.pdf * float(branches);
    seen = seen && specular && branches == 1;
    vertex = s.position;
    vertexNormal = back ? -s.normal : s.normal;
    vertexTwoSided = bsdf.transmits();
    vertexSurface = hit.surface;
    vertexInstanceCategories = hit.instanceCategories;
    diffuseShare = vec3(next.diffuse ? 1.0f : 0.0f);
    if (splitsLobes && !specular) {
        const BsdfEval f = bsdf.evalDrawn(next);
        const vec3 sum = f.diffuse + f.specular;
        for (int c = 0; c < 3; ++c)
            diffuseShare[c] = sum[c] > 0.0f ? f.diffuse[c] / sum[c] : 0.5f;
    }
    specularShare = vec3(1.0f) - diffuseShare;
    if (lightPaths) recordScatter(*lightPaths, next, bsdf);
    origin = point.departure(next.wi);
    direction = next.wi;
    departs = true;
    near = 0.0f;
    far = INFINITY;
    coneSpread = std::min(1.0f, coneSpread + 0.5f * next.roughness);
    blur = std::min(1.0f, blur + next.roughness);
}

/// Those of little light alone: what ends sooner saves less time than its noise costs. A path that
/// scatters in a bright medium goes on for long and should, and so should one in a white room, up
/// to a depth. Paths of a pixel share evenly spread numbers.
bool Path::survivesRoulette(int rouletteDepth) {
    if (depth + scatterings <= rouletteDepth) return true;
    const float bound = scatterings > 0 || depth <= endlessDepth ? 1.0f : 0.95f;
    const float left = std::max({throughput.x, throughput.y, throughput.z}) / share;
    const float survive = std::min(bound, left / rouletteBelow);
    if (survive >= 1.0f) return true;
    if (sampler.next2().x >= survive) return false;
    throughput /= survive;
    return true;
}

} // namespace patina
