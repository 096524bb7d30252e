// SPDX-License-Identifier: Apache-2.0
#include "shaders/areaLights.h"
#include "shaders/lights.h"
#include "shaders/measure/measure.h"
#include "shaders/measure/reflector.h"

#include <random>

#include <glm/glm.hpp>

namespace patina::measure {

namespace {

using sh::vec2;
using sh::vec3;

constexpr int gridSide = 8;    ///< places: cosines, and roots of alpha
constexpr int fineSteps = 100; ///< places along a side of the light, for the truth
constexpr int poseCount = 5;
constexpr float pi = 3.14159265f;

/// As lightTrust and the samples of the material of shaders/raster/lighting.frag.glsl.
constexpr float lightTrust = 8.0f;
constexpr int materialSamples = 2;

/// A shape of ltcOutline() with radiance 1, seen from a point in whose frame the normal is z.
struct AreaLight {
    int kind;
    vec3 origin, x, y, z; ///< places are origin + x a + y b + z c

    /// @param u in the unit square @returns a place; n: the normal there, times the area for all u
    vec3 at(vec2 u, vec3& n) const {
        const float a = 2.0f * pi * u.y;
        vec3 p(u.x - 0.5f, u.y - 0.5f, 0.0f);
        if (kind == sh::LTC_RECT) {
            n = glm::cross(x, y);
        } else if (kind == sh::LTC_DISK) {
            p = std::sqrt(u.x) * vec3(std::cos(a), std::sin(a), 0.0f);
            n = pi * glm::cross(x, y);
        } else if (kind == sh::LTC_SPHERE) {
            const float h = 2.0f * u.x - 1.0f, r = std::sqrt(1.0f - h * h);
            p = vec3(r * std::cos(a), r * std::sin(a), h);
            n = 4.0f * pi * glm::dot(x, x) * glm::normalize(x * p.x + y * p.y + z * p.z);
        } else {
            p = vec3(u.x - 0.5f, std::cos(a), std::sin(a));
            n = 2.0f * pi * glm::length(x) * glm::length(y) * glm::normalize(y * p.y + z * p.z);
        }
        return origin + x * p.x + y * p.y + z * p.z;
    }

    /// The direction to a place, and its density by solid angle; 0 where it shines away.
    float density(const vec3& p, const vec3& n, vec3& wi) const {
        const float d2 = glm::dot(p, p);
        wi = p / std::sqrt(d2);
        const float c = -glm::dot(n, wi); // times the area
        return c > 1e-9f ? d2 / c : 0.0f;
    }

    vec3 toShape(const vec3& v) const {
        return vec3(glm::dot(v, x) / glm::dot(x, x), glm::dot(v, y) / glm::dot(y, y),
                    glm::dot(v, z) / glm::dot(z, z));
    }

    /// A direction to a sample of the rasterizer, and its density by solid angle.
    float sample(vec3 u, vec3& wi) const {
        if (kind == sh::LTC_SPHERE) {
            const vec3 q = shLights::sphereLightPlace(u);
            wi = glm::normalize(origin + x * q.x + y * q.y + z * q.z);
            return densityAlong(wi);
        }
        vec3 n;
        const vec3 p = at(vec2(u), n);
        return density(p, n, wi);
    }

    /// Density with which sample() finds a direction; 0 where there is no light.
    float densityAlong(const vec3& wi) const {
        const vec3 o = toShape(-origin), d = toShape(wi);
        float t = -1.0f;
        if (kind == sh::LTC_SPHERE) {
            const float volume = std::fabs(glm::dot(glm::cross(x, y), z));
            float found;
            return shLights::sphereLightHit(o, d, volume, t, found) ? found : 0.0f;
        }
        if (kind == sh::LTC_CYLINDER) {
            const float a = d.y * d.y + d.z * d.z, b = o.y * d.y + o.z * d.z,
                        c = o.y * o.y + o.z * o.z - 1.0f, root = b * b - a * c;
            if (a < 1e-12f || root < 0.0f) return 0.0f;
            t = (-b - std::sqrt(root)) / a;
            if (std::fabs(o.x + d.x * t) > 0.5f) return 0.0f;
        } else {
            t = std::fabs(d.z) > 1e-9f ? -o.z / d.z : -1.0f;
            const vec3 p = o + d * t;
            const bool inside = kind == sh::LTC_RECT
                                    ? std::max(std::fabs(p.x), std::fabs(p.y)) <= 0.5f
                                    : p.x * p.x + p.y * p.y <= 1.0f;
            if (!inside) return 0.0f;
        }
        if (t <= 0.0f) return 0.0f;
        const vec3 p = wi * t, local = o + d * t;
        vec3 n, unused;
        at(vec2(0.5f), n);
        if (kind == sh::LTC_CYLINDER)
            n = glm::length(n) * glm::normalize(y * local.y + z * local.z);
        return density(p, n, unused);
    }
};

/// A light beside the direction in which a mirror would show it, or edge on; for diffuse lobes on
/// all sides.
AreaLight pose(int kind, bool edgeOn, bool around, const vec3& wo, int i) {
    const float offset = 0.35f * float(i - 1), turned = 2.4f * float(i);
    const float about = around ? pi + 0.4f * pi * float(i) : pi;
    vec3 to = glm::normalize(vec3(wo.x * std::cos(about), wo.x * std::sin(about), wo.z) +
                             offset * vec3(std::cos(turned), std::sin(turned), 0.7f));
    to.z = std::max(to.z, 0.05f);
    to = glm::normalize(to);
    AreaLight l{kind, 1.6f * to, vec3(0.0f), vec3(0.0f), vec3(0.0f)};
    vec3 n = -to;
    const vec3 side =
        glm::normalize(glm::cross(std::fabs(n.z) < 0.9f ? vec3(0, 0, 1) : vec3(1, 0, 0), n));
    if (edgeOn) n = glm::normalize(n + 4.0f * side);
    l.x = glm::normalize(glm::cross(vec3(0.3f, 0.9f, 0.2f), n));
    l.y = glm::cross(n, l.x);
    l.z = n;
    const bool flat = kind == sh::LTC_RECT || kind == sh::LTC_DISK;
    const float size = kind == sh::LTC_RECT ? 1.0f : kind == sh::LTC_CYLINDER ? 0.25f : 0.4f;
    const float length = kind == sh::LTC_CYLINDER ? 1.2f : size;
    l.x *= length;
    l.y *= size;
    l.z *= flat ? 1.0f : size;
    return l;
}

double brute(const Reflector& f, const AreaLight& l) {
    double sum = 0.0;
    for (int i = 0; i < fineSteps * fineSteps; ++i) {
        vec3 n, wi;
        const vec3 p =
            l.at((vec2(float(i % fineSteps), float(i / fineSteps)) + 0.5f) / float(fineSteps), n);
        const float density = l.density(p, n, wi);
        if (density > 0.0f && wi.z > 0.0f) sum += f.eval(wi).value.x / density;
    }
    return sum / (double(fineSteps) * fineSteps);
}

/// As the rasterizer: a place on the light per pass, and samples of the material.
double sampled(const Reflector& f, const AreaLight& l, int passes, std::mt19937& random) {
    std::uniform_real_distribution<float> u(0.0f, 1.0f);
    const auto heuristic = [](float a, float b) { return a * a / std::max(a * a + b * b, 1e-30f); };
    double sum = 0.0;
    for (int i = 0; i < passes; ++i) {
        vec3 wi;
        const float density = l.sample(vec3(u(random), u(random), u(random)), wi);
        if (density > 0.0f && wi.z > 0.0f) {
            const sh::LobeEval e = f.eval(wi);
            sum += e.value.x / density *
                   heuristic(lightTrust * density, float(materialSamples) * e.pdf);
        }
        for (int k = 0; k < materialSamples; ++k) {
            const sh::LobeSample s = f.sample(vec3(u(random), u(random), u(random)));
            if (s.event == 0 || s.wi.z <= 0.0f) continue;
            const float found = l.densityAlong(s.wi);
            if (found > 0.0f)
                sum += s.weight.x / materialSamples *
                       heuristic(float(materialSamples) * s.pdf, lightTrust * found);
        }
    }
    return sum / passes;
}

double truth(const Reflector& f, const AreaLight& l) {
    if (f.alpha >= 0.01f) return brute(f, l);
    std::mt19937 random(3); // sharp lobes fall between places
    return sampled(f, l, 4096, random);
}

double byOutline(const Reflector& f, const AreaLight& l) {
    sh::LtcOutline outline = sh::ltcOutline(l.kind, l.toShape(-l.origin));
    if (outline.count == 0) return 0.0;
    if ((l.kind == sh::LTC_RECT || l.kind == sh::LTC_DISK) && glm::dot(l.z, l.origin) >= 0.0f)
        return 0.0;
    for (int i = 0; i < outline.count; ++i) {
        const vec3& c = outline.corners[i];
        outline.corners[i] = sh::ltcTurned(l.origin + l.x * c.x + l.y * c.y + l.z * c.z, f.wo);
    }
    const sh::vec4 map =
        !f.mirrors() ? sh::vec4(1.0f, 0.0f, 1.0f, 0.0f) : sh::ltcMicrofacets(f.wo, f.alpha);
    return double(f.albedo() * sh::ltcShare(outline.corners, outline.count, map));
}

} // namespace

// Light of an area light without shadows: a light's samples and the material's, and the outline,
// against a sum over 10000 places of the light, or 4096 samples. Below alpha 0.01,
// in the first bin, the rasterizer samples whatever the method.
std::vector<Row> areaLight(bool timed) {
    const struct {
        const char* name;
        int kind;
        bool edgeOn;
    } shapes[] = {{"rect", sh::LTC_RECT, false},
                  {"rect, edge on", sh::LTC_RECT, true},
                  {"disk", sh::LTC_DISK, false},
                  {"sphere", sh::LTC_SPHERE, false},
                  {"cylinder", sh::LTC_CYLINDER, false}};
    const std::vector<Place> grid = places(gridSide);
    std::vector<Row> rows;
    for (const auto kind : {Reflector::Diffuse, Reflector::Dielectric, Reflector::Conductor})
        for (const auto& shape : shapes) {
            std::vector<Reflector> lobes;
            std::vector<AreaLight> lights;
            std::vector<double> truths;
            for (const Place& p : grid)
                for (int i = 0; i < poseCount; ++i) {
                    lobes.emplace_back(kind, p);
                    lights.push_back(pose(shape.kind, shape.edgeOn, !lobes.back().mirrors(),
                                          lobes.back().wo, i));
                    truths.push_back(truth(lobes.back(), lights.back()));
                }
            for (const int passes : {0, 1, 4, 16, 64}) {
                Row row;
                row.point = "areaLight";
                row.method = passes ? "sampled" : "linearlyTransformedCosines";
                row.subject = std::string(Reflector::name(kind)) + ", " + shape.name +
                              (passes > 1 ? ", " + std::to_string(passes) + " samples" : "");
                row.error = "light";
                row.kind = Reflector::name(kind);
                const auto value = [&](size_t i, std::mt19937& random) {
                    return passes ? sampled(lobes[i], lights[i], passes, random)
                                  : byOutline(lobes[i], lights[i]);
                };
                std::mt19937 random(5);
                Errors errors;
                for (size_t i = 0; i < lobes.size(); ++i)
                    errors.add(value(i, random) - truths[i], truths[i],
                               std::sqrt(double(lobes[i].alpha)), lobes[i].wo.z);
                errors.into(row);
                if (timed)
                    time(
                        [&](int n) {
                            double sum = 0.0;
                            for (int i = 0; i < n; ++i)
                                sum += value(size_t(i) * 7 % lobes.size(), random);
                            return sum;
                        },
                        passes > 4 ? 16 : 128, row);
                rows.push_back(row);
            }
        }
    return rows;
}

} // namespace patina::measure
