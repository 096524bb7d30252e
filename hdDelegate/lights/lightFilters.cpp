// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/lights/lightFilters.h"

#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/scene/lightUnits.h"
#include "base/diagnostics.h"

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
        curve.kind = shLights::CURVE_CONSTANT;
    else if (kind == "catmull-rom" || kind == "catmullRom")
        curve.kind = shLights::CURVE_CATMULL_ROM;
    else if (kind == "bspline")
        curve.kind = shLights::CURVE_BSPLINE;
    const bool fits = curve.knots.size() == curve.values.size() &&
                      std::is_sorted(curve.knots.begin(), curve.knots.end());
    if (!fits) diagnostics.warn(light, "light:filters", messages::rampUnusable(f.path));
    if (!fits || curve.values.empty()) {
        curve.knots = {0.0f, 1.0f};
        curve.values = {vec3(1.0f), vec3(colors ? 1.0f : 0.0f)};
        curve.kind = shLights::CURVE_LINEAR;
    }
    return curve;
}

vec3 LightFilters::Curve::at(float x) const {
    const int last = int(knots.size()) - 1;
    const int above = int(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin());
    if (above == 0) return values.front();
    if (above > last) return values.back();
    const size_t i = size_t(above - 1), next = size_t(above);
    const vec4 w = shLights::curveWeights(kind, (x - knots[i]) / (knots[next] - knots[i]));
    return w.x * values[i > 0 ? i - 1 : 0] + w.y * values[i] + w.z * values[next] +
           w.w * values[size_t(std::min(above + 1, last))];
}

/// @returns false where there is none
bool LightFilters::addImage(const LightFilter& f, const std::string& light, LightImages& images,
                            Diagnostics& diagnostics, Filter& to) {
    const auto warn = [&](const Message& what) { diagnostics.warn(light, "light:filters", what); };
    if (f.textureFile.empty()) {
        warn(messages::filterWithoutMap(f.path));
        return false;
    }
    to.shown.size = vec2(f.width * f.scaleU, f.height * f.scaleV);
    to.shown.center = vec2(f.width * f.offsetU, f.height * f.offsetV);
    const vec2 size = to.shown.size * to.shown.center;
    if (to.shown.size.x == 0.0f || to.shown.size.y == 0.0f || !std::isfinite(size.x + size.y)) {
        warn(messages::filterImageUnusable(f.path));
        return false;
    }
    if (f.invertU) to.shown.size.x *= -1.0f;
    if (f.invertV) to.shown.size.y *= -1.0f;
    to.shown.wrap = choiceOf(f.textureWrap, {"off", "clamp", "repeat"});
    if (to.shown.wrap < 0) {
        warn(messages::tileModeUnknown(f.path, f.textureWrap));
        to.shown.wrap = shLights::IMAGE_OFF;
    }
    to.image = images.image(f.textureFile, "", light, "light:filters " + f.path + " map");
    to.shown.width = to.image->width;
    to.shown.height = to.image->height;
    to.fill = f.fillColor;
    return true;
}

LightFilters::LightFilters(const Light& light, const mat4& groupToWorld, const dvec3& origin,
                           float time, LightImages& images, Diagnostics& diagnostics)
    : _group(groupToWorld), _origin(origin) {
    for (const LightFilter& f : light.filters) {
        const auto warn = [&](const Message& what) {
            diagnostics.warn(light.path, "light:filters", what);
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
            warn(messages::filterFlat(f.path));
            continue;
        }
        const int mode = choiceOf(f.mode, {"physical", "analytic"});
        if (mode < 0) warn(messages::filterModeUnknown(f.path, f.mode));
        filter.analytic = mode == 1;
        filter.directional = f.directional;
        filter.shear = vec2(f.shearX / f.scaleWidth, f.shearY / f.scaleHeight);
        filter.apex = f.apex;
        filter.density = std::clamp(f.density, 0.0f, 1.0f);
        if (filter.density != f.density) warn(messages::filterDensityClamped(f.path));
        filter.invert = f.invert;
        filter.intensity = f.intensity;
        if (f.type == LightFilterType::Multiplier) filter.intensity *= std::exp2(f.exposure);
        if (!std::isfinite(filter.intensity + f.density)) {
            warn(messages::filterNotFinite(f.path));
            continue;
        }
        if (f.type == LightFilterType::Ramp) {
            filter.rampType =
                choiceOf(f.rampType, {"distanceToLight", "linear", "spherical", "radial"});
            if (filter.rampType < 0) {
                warn(messages::rampTypeUnknown(f.path, f.rampType));
                filter.rampType = 0;
            }
            filter.start = f.beginDistance;
            filter.end = f.endDistance;
            filter.ramp = curveOf(f, false, light.path, diagnostics);
            filter.colors = curveOf(f, true, light.path, diagnostics);
        }
        const bool shows = f.type == LightFilterType::Cookie || f.type == LightFilterType::Gobo;
        if (shows && !addImage(f, light.path, images, diagnostics, filter)) continue;
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
    shLights::TableCell c;
    if (!shLights::filterTexels(f.shown, at, c)) return f.fill;
    const std::vector<vec3>& pixels = f.image->pixels;
    return tableMix(c, pixels[size_t(c.low)], pixels[size_t(c.lowNext)], pixels[size_t(c.high)],
                    pixels[size_t(c.highNext)]);
}

vec3 LightFilters::factorOf(const Filter& f, const vec3& point, const vec3& direction,
                            float distance, float time) const {
    if (f.type == LightFilterType::Multiplier)
        return vec3(1.0f - f.density + f.density * f.intensity);
    const mat4 toFilter = f.transform.moves() ? toFilterAt(f, time) : f.toFilter;
    const vec3 p(toFilter * vec4(point, 1.0f));
    vec3 value(1.0f);
    if (f.type == LightFilterType::Rod)
        return vec3(shLights::rodStrength(shLights::filterBoxCover(f.box, p), f.invert, f.density,
                                          f.intensity));
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
        const bool crossed = shLights::openingCrossed(p, toLight, reach, at);
        if (!crossed && !f.fillsBehind()) return value;
        value = !crossed                          ? f.fill
                : f.type == LightFilterType::Barn ? vec3(shLights::filterBoxCover(f.box, at))
                                                  : texel(f, at);
    }
    return shLights::filterStrength(value, f.invert, f.density, f.intensity);
}

vec3 LightFilters::factor(const vec3& point, const vec3& direction, float distance,
                          float time) const {
    vec3 product(1.0f);
    for (const Filter& f : _filters)
        product *= factorOf(f, point, direction, distance, time);
    return product;
}

} // namespace patina
