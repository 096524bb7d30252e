// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightFilters.h"

#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/scene/lightUnits.h"
#include "materialNetwork/diagnostics.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// A word, or its number as RenderMan writes it. @returns -1 for neither
int choiceOf(const std::string& given, std::initializer_list<const char*> words) {
    int i = 0;
    for (const char* word : words) {
        if (given == word || given == std::to_string(i)) return i;
        ++i;
    }
    return -1;
}

shLights::FilterBox boxOf(const LightFilter& f) {
    const bool flat = f.type != LightFilterType::Rod;
    shLights::FilterBox box;
    const vec3 half(0.5f * f.width, 0.5f * f.height, flat ? 0.0f : 0.5f * f.depth);
    box.low = -half - vec3(f.left, f.bottom, flat ? 0.0f : f.back);
    box.high = half + vec3(f.right, f.top, flat ? 0.0f : f.front);
    box.edgeLow = f.edge * vec3(f.leftEdge, f.bottomEdge, f.backEdge);
    box.edgeHigh = f.edge * vec3(f.rightEdge, f.topEdge, f.frontEdge);
    box.radius = std::max(f.radius, 0.0f);
    return box;
}

} // namespace

LightFilters::Curve LightFilters::curveOf(const LightFilter& f, bool colors,
                                          const std::string& light, Diagnostics& diagnostics) {
    Curve curve;
    curve.knots = colors ? f.colorKnots : f.rampKnots;
    if (colors)
        curve.values = f.colors;
    else
        for (float value : f.rampFloats)
            curve.values.emplace_back(value);
    const std::string& kind = colors ? f.colorInterpolation : f.rampInterpolation;
    if (kind == "constant")
        curve.kind = Curve::Kind::Constant;
    else if (kind == "catmull-rom" || kind == "catmullRom")
        curve.kind = Curve::Kind::CatmullRom;
    else if (kind == "bspline")
        curve.kind = Curve::Kind::BSpline;
    const bool fits = curve.knots.size() == curve.values.size() &&
                      std::is_sorted(curve.knots.begin(), curve.knots.end());
    if (!fits)
        diagnostics.warn(light, "light:filters",
                         f.path + " has a ramp whose knots do not ascend or are not as many as its "
                                  "values; the fallback is used");
    if (!fits || curve.values.empty()) {
        curve.knots = {0.0f, 1.0f};
        curve.values = {vec3(1.0f), vec3(colors ? 1.0f : 0.0f)};
        curve.kind = Curve::Kind::Linear;
    }
    return curve;
}

vec3 LightFilters::Curve::at(float x) const {
    const int last = int(knots.size()) - 1;
    const int above = int(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin());
    if (above == 0) return values.front();
    if (above > last) return values.back();
    const int i = above - 1;
    if (kind == Kind::Constant) return values[size_t(i)];
    const float t = (x - knots[size_t(i)]) / (knots[size_t(above)] - knots[size_t(i)]);
    const vec3 &p1 = values[size_t(i)], &p2 = values[size_t(above)];
    if (kind == Kind::Linear) return p1 + t * (p2 - p1);
    const vec3 &p0 = values[size_t(std::max(i - 1, 0))],
               &p3 = values[size_t(std::min(above + 1, last))];
    if (kind == Kind::CatmullRom)
        return p1 + 0.5f * t *
                        ((p2 - p0) + t * ((2.0f * p0 - 5.0f * p1 + 4.0f * p2 - p3) +
                                          t * (3.0f * (p1 - p2) + p3 - p0)));
    const float s = 1.0f - t;
    return (s * s * s * p0 + (3.0f * t * t * t - 6.0f * t * t + 4.0f) * p1 +
            (3.0f * s * s * s - 6.0f * s * s + 4.0f) * p2 + t * t * t * p3) /
           6.0f;
}

LightFilters::LightFilters(const Light& light, const mat4& groupToWorld, const dvec3& origin,
                           float time, LightImages& images, Diagnostics& diagnostics)
    : _group(groupToWorld), _origin(origin) {
    for (const LightFilter& f : light.filters) {
        const auto warn = [&](const std::string& message) {
            diagnostics.warn(light.path, "light:filters", f.path + " " + message);
        };
        Filter filter;
        filter.type = f.type;
        filter.transform = f.transform;
        filter.scale =
            vec3(f.scaleWidth, f.scaleHeight, f.type == LightFilterType::Rod ? f.scaleDepth : 1.0f);
        filter.box = boxOf(f);
        filter.toFilter = toFilterAt(filter, time);
        const bool places = f.type != LightFilterType::Multiplier;
        if (places && !isFinite(filter.toFilter)) {
            warn("is flattened to nothing or not finite; it is left out");
            continue;
        }
        const int mode = choiceOf(f.mode, {"physical", "analytic"});
        if (mode < 0) warn("has an unknown mode '" + f.mode + "'; physical is used");
        filter.analytic = mode == 1;
        filter.directional = f.directional;
        filter.shear = vec2(f.shearX / f.scaleWidth, f.shearY / f.scaleHeight);
        filter.apex = f.apex;
        filter.density = std::clamp(f.density, 0.0f, 1.0f);
        if (filter.density != f.density)
            warn("has a density that is not within 0..1; it is clamped");
        filter.invert = f.invert;
        filter.intensity = f.intensity;
        if (f.type == LightFilterType::Multiplier) filter.intensity *= std::exp2(f.exposure);
        if (!std::isfinite(filter.intensity + f.density)) {
            warn("has a density or intensity that is not finite; it is left out");
            continue;
        }
        if (f.type == LightFilterType::Ramp) {
            filter.rampType =
                choiceOf(f.rampType, {"distanceToLight", "linear", "spherical", "radial"});
            if (filter.rampType < 0) {
                warn("has an unknown rampType '" + f.rampType + "'; distanceToLight is used");
                filter.rampType = 0;
            }
            filter.start = f.beginDistance;
            filter.end = f.endDistance;
            filter.ramp = curveOf(f, false, light.path, diagnostics);
            filter.colors = curveOf(f, true, light.path, diagnostics);
        }
        if (f.type == LightFilterType::Cookie) {
            if (f.textureFile.empty()) {
                warn("has no map; it is left out");
                continue;
            }
            filter.image =
                images.image(f.textureFile, "", light.path, "light:filters " + f.path + " map");
            filter.imageSize = vec2(f.width, f.height);
            filter.fill = f.fillColor;
            filter.invertU = f.invertU;
            filter.invertV = f.invertV;
            filter.wrap = choiceOf(f.textureWrap, {"off", "repeat", "clamp"});
            if (filter.wrap < 0) {
                warn("has an unknown tileMode '" + f.textureWrap + "'; off is used");
                filter.wrap = 0;
            }
        }
        _filters.push_back(std::move(filter));
    }
}

mat4 LightFilters::toFilterAt(const Filter& filter, float time) const {
    mat4 m = glm::inverse(_group * transformAt(filter.transform, time, _origin));
    for (int c = 0; c < 4; ++c)
        m[c] = vec4(vec3(m[c]) / filter.scale, m[c].w);
    return m;
}

vec3 LightFilters::texel(const Filter& f, const vec3& at) {
    float u = 0.5f + at.x / f.imageSize.x, v = 0.5f - at.y / f.imageSize.y;
    if (f.invertU) u = 1.0f - u;
    if (f.invertV) v = 1.0f - v;
    if (f.wrap == 0 && !(u >= 0.0f && u <= 1.0f && v >= 0.0f && v <= 1.0f)) return f.fill;
    if (f.wrap == 1) {
        u -= std::floor(u);
        v -= std::floor(v);
    }
    const int w = f.image->width, h = f.image->height;
    const auto place = [&](float at01, int size, int& low, int& high, float& t) {
        const float x = std::clamp(at01, 0.0f, 1.0f) * float(size) - 0.5f;
        const float below = std::floor(x);
        t = x - below;
        const auto kept = [&](int i) {
            return f.wrap == 1 ? (i + size) % size : std::clamp(i, 0, size - 1);
        };
        low = kept(int(below));
        high = kept(int(below) + 1);
    };
    int x0, x1, y0, y1;
    float tx, ty;
    place(u, w, x0, x1, tx);
    place(v, h, y0, y1, ty);
    const auto pixel = [&](int x, int y) {
        return f.image->pixels[size_t(y) * size_t(w) + size_t(x)];
    };
    return glm::mix(glm::mix(pixel(x0, y0), pixel(x1, y0), tx),
                    glm::mix(pixel(x0, y1), pixel(x1, y1), tx), ty);
}

vec3 LightFilters::factorOf(const Filter& f, const vec3& point, const vec3& direction,
                            float distance, float time) const {
    if (f.type == LightFilterType::Multiplier) return vec3(1.0f + f.density * (f.intensity - 1.0f));
    const mat4 toFilter = f.transform.moves() ? toFilterAt(f, time) : f.toFilter;
    const vec3 p(toFilter * vec4(point, 1.0f));
    vec3 value(1.0f);
    if (f.type == LightFilterType::Rod) {
        // Inside of it the light has another strength.
        float cover = shLights::filterBoxCover(f.box, p);
        if (f.invert) cover = 1.0f - cover;
        return vec3(1.0f + f.density * cover * (f.intensity - 1.0f));
    }
    if (f.type == LightFilterType::Ramp) {
        const float x = shLights::rampPlace(f.rampType, p, distance, f.start, f.end);
        value = f.ramp.at(x) * f.colors.at(x);
    } else {
        const bool infinite = std::isinf(distance);
        vec3 toLight = glm::mat3(toFilter) * direction;
        if (!infinite) toLight *= distance;
        float reach = infinite ? INFINITY : 1.0f;
        if (f.analytic) {
            toLight = shLights::openingAnalytic(p, f.directional, f.shear, f.apex);
            reach = f.directional ? INFINITY : 1.0f;
        }
        vec3 at;
        if (!shLights::openingCrossed(p, toLight, reach, at)) return value;
        value = f.type == LightFilterType::Barn ? vec3(shLights::filterBoxCover(f.box, at))
                                                : texel(f, at);
    }
    if (f.invert) value = vec3(1.0f) - value;
    return (vec3(1.0f) + f.density * (value - vec3(1.0f))) * f.intensity;
}

vec3 LightFilters::factor(const vec3& point, const vec3& direction, float distance,
                          float time) const {
    vec3 product(1.0f);
    for (const Filter& f : _filters)
        product *= factorOf(f, point, direction, distance, time);
    return product;
}

} // namespace patina
