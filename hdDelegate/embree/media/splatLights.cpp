// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/splatLights.h"

#include "base/maths.h"
#include "shaders/closure.h"

#include <algorithm>
#include <cmath>

namespace patina {

void SplatLights::add(const SplatKernels& kernels, const mat4& toWorld, size_t places) {
    const auto& list = kernels.list();
    const SplatCloud& cloud = kernels.cloud();
    const size_t count = std::min(most / std::max<size_t>(places, 1), list.size());
    const float scale = std::max({glm::length(vec3(toWorld[0])), glm::length(vec3(toWorld[1])),
                                  glm::length(vec3(toWorld[2]))});
    shSplats::SplatBasis mean{}; // the colour without what depends on the direction
    mean.at[0] = shSplats::splatBasis(vec3(0, 0, 1)).at[0];
    for (size_t c = 0; c < count; ++c) { // neighbours in the list are neighbours in space
        double flux = 0.0, squares = 0.0, wide = 0.0;
        glm::dvec3 sum(0.0);
        for (size_t i = c * list.size() / count; i < (c + 1) * list.size() / count; ++i) {
            vec3 s = cloud.scales.empty() ? vec3(1.0f) : cloud.scales[list[i].particle];
            std::sort(&s.x, &s.x + 3);
            const vec3 light = kernels.radiance(uint32_t(i), mean);
            const double power =
                double(list[i].opacity) * s.y * s.z * (light.x + light.y + light.z);
            const glm::dvec3 at(list[i].center);
            flux += power;
            sum += power * at;
            squares += power * glm::dot(at, at);
            wide += power * s.z * s.z;
        }
        if (!(flux > 0.0)) continue;
        const glm::dvec3 center = sum / flux;
        // Around most of the light of an even ball, and of one kernel. Where that is not all of it,
        // samples of the BSDF find the rest.
        const double spread = std::max(squares / flux - glm::dot(center, center), 0.0);
        const double radius = std::sqrt(1.7 * spread + 5.0 * wide / flux);
        const Cluster cluster{vec3(toWorld * vec4(vec3(center), 1.0f)), scale * float(radius),
                              scale * scale * float(flux)};
        if (std::isfinite(cluster.radius + cluster.flux)) _clusters.push_back(cluster);
    }
}

bool SplatLights::cones(const vec3& point, const vec3& normal, Cones& cones) const {
    float sum = 0.0f;
    for (size_t i = 0; i < _clusters.size(); ++i) {
        const Cluster& cluster = _clusters[i];
        const vec3 to = cluster.center - point;
        const float squared = glm::dot(to, to), radius = cluster.radius;
        cones[i] = {};
        // From within, samples of the BSDF do as well.
        if (!(squared > 1.5f * radius * radius) || !(glm::dot(to, normal) > -radius)) continue;
        const float sine = radius * radius / squared; // squared
        cones[i].axis = to / std::sqrt(squared);
        cones[i].versine = std::max(sine / (1.0f + std::sqrt(1.0f - sine)), 1e-7f);
        cones[i].chance = cluster.flux / squared;
        sum += cones[i].chance;
    }
    for (size_t i = 0; sum > 0.0f && i < _clusters.size(); ++i)
        cones[i].chance /= sum;
    return sum > 0.0f;
}

float SplatLights::density(const Cones& cones, const vec3& direction) const {
    float sum = 0.0f;
    for (size_t i = 0; i < _clusters.size(); ++i) {
        const Cone& cone = cones[i];
        const vec3 away = direction - cone.axis; // half of its square is 1 - cosine, to all digits
        if (cone.chance > 0.0f && 0.5f * glm::dot(away, away) <= cone.versine)
            sum += cone.chance / (2.0f * pi * cone.versine);
    }
    return sum;
}

SplatLights::Direction SplatLights::sample(const vec3& point, const vec3& normal,
                                           const vec3& u) const {
    Cones all;
    if (!cones(point, normal, all)) return {};
    size_t chosen = 0;
    float choice = u.x;
    for (size_t i = 0; i < _clusters.size(); ++i) {
        if (!(all[i].chance > 0.0f)) continue;
        chosen = i;
        if (choice < all[i].chance) break;
        choice -= all[i].chance;
    }
    const Cone& cone = all[chosen];
    const float versine = u.y * cone.versine * (1.0f - 1e-6f);
    const float sine = std::sqrt(versine * (2.0f - versine)), turn = 2.0f * pi * u.z;
    vec3 x, y;
    sh::completeBasis(cone.axis, x, y);
    Direction out;
    out.direction = glm::normalize((1.0f - versine) * cone.axis +
                                   sine * (std::cos(turn) * x + std::sin(turn) * y));
    out.pdf = density(all, out.direction);
    return out;
}

float SplatLights::pdf(const vec3& point, const vec3& normal, const vec3& direction) const {
    Cones all;
    return cones(point, normal, all) ? density(all, direction) : 0.0f;
}

} // namespace patina
