// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterLightPlan.h"

#include "materialNetwork/plan/methods.h"
#include "materialNetwork/planner/planner.h"
#include "materialNetwork/planner/predictLight.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace patina {

namespace {

/// Lights at places, from this number on, among which pixels choose; see LightCells.
constexpr int many = 17;

constexpr int side = 64, inner = 4; ///< cells of a sky, and what is looked at in each
/// Skies have other features than the two that rows are of: as much again is allowed for them.
constexpr double otherSkies = 2.0;

/// The passes of a row of samples.
constexpr double rowPasses = 16.0;
const std::string passes = "16 passes";

/// Passes until noise that is `error` after rowPasses falls to `allowed`.
double passesFor(double error, double allowed, const RenderSettings& settings) {
    const double minimum = std::max(2, settings.minSamples);
    const double needed = rowPasses * std::pow(error / std::max(allowed, 1e-9), 2.0);
    return std::clamp(needed, minimum, 1e9);
}

std::string samplesOf(int count) {
    return std::to_string(count) + " samples";
}

PlannedMethod made(const std::string& point, const std::string& method, double error, double ns,
                   double nsSampled, bool forced) {
    PlannedMethod m;
    m.point = point;
    m.method = method;
    m.forced = forced;
    m.measured = true;
    m.error = error;
    m.ns = ns;
    m.nsDefault = m.nsTruth = nsSampled;
    return m;
}

} // namespace

double peakShare(const EnvironmentMap& map) {
    std::vector<double> light;
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i) {
        double y = 0.0;
        for (int k = 0; k < inner * inner; ++k) {
            // Cells are equally large: even steps of height and angle.
            const double u = (i % side + (k % inner + 0.5) / inner) / side;
            const double v = (i / side + (k / inner + 0.5) / inner) / side;
            const double z = 1.0 - 2.0 * v, r = std::sqrt(std::max(1.0 - z * z, 0.0));
            const double phi = 6.28318530717958648 * u;
            const vec3 c =
                map.radiance(vec3(float(r * std::cos(phi)), float(z), float(r * std::sin(phi))));
            const double l = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
            y += std::isfinite(l) ? std::max(l, 0.0) : 0.0;
        }
        light.push_back(y);
        sum += y;
    }
    std::sort(light.begin(), light.end(), std::greater<double>());
    double peak = 0.0;
    for (int i = 0; i < side * side / 100; ++i)
        peak += light[size_t(i)];
    return sum > 0.0 ? peak / sum : 0.0;
}

RasterLightPlan RasterLightPlan::of(const SceneState& state, const RenderSettings& settings,
                                    RasterInstances& places, LightImages& images) {
    RasterLightPlan plan;
    if (!settings.enableSceneLights) return plan;
    size_t placed = 0;
    for (const auto& item : state.lights) {
        const Light& light = *item.second;
        if (!light.visible) continue;
        const bool dome = light.type == LightType::Dome;
        if (!dome && light.type != LightType::Distant && light.type != LightType::Mesh)
            placed += places.places(light.group).size();
        plan._images |= light.hasImage();
        plan._profiles |= !light.iesFile.empty();
        plan._sky |= dome || light.type == LightType::Distant;
        plan._fades |= light.shadowDistance > 0.0f;
        if (light.filters.empty()) continue;
        plan.needFilters();
        if (dome) plan.needSamples();
    }
    if (placed >= size_t(many)) plan.needChoice();
    if (settings.tolerance < 0.0) return plan;
    for (const auto& item : state.geometry)
        if (item.second->kind == GeometryKind::Volume) plan.needSamples();
    for (const auto& item : state.lights) {
        const Light& light = *item.second;
        if (!light.visible) continue;
        if (light.type != LightType::Dome) {
            plan.addArea(light);
            continue;
        }
        std::shared_ptr<const EnvironmentMap> map;
        if (light.hasImage()) map = images.environment(light);
        plan.addDome(map.get());
    }
    return plan;
}

std::string RasterLightPlan::text() const {
    if (!_needsChoice) return std::string();
    std::string text = "#define MANY_LIGHTS\n";
    if (!_images) text += "#define PATINA_LIGHT_IMAGE(has) false\n";
    if (!_profiles) text += "#define PATINA_LIGHT_PROFILE(has) false\n";
    if (!_sky) text += "#define PATINA_LIGHT_SKY(is) false\n";
    if (!_fades) text += "#define PATINA_LIGHT_FADES(does) false\n";
    return text;
}

void RasterLightPlan::addDome(const EnvironmentMap* map) {
    _hasDome = true;
    _peak = std::max(_peak, map ? peakShare(*map) : evenPeak);
}

void RasterLightPlan::addArea(const Light& light) {
    switch (light.type) {
    case LightType::Rect: _areas.insert({"rect", "rect, edge on"}); break;
    case LightType::Disk: _areas.insert("disk"); break;
    case LightType::Sphere:
        if (!light.treatAsPoint) _areas.insert("sphere");
        break;
    case LightType::Cylinder:
        if (!light.treatAsLine) _areas.insert("cylinder");
        break;
    default: break;
    }
}

RasterLightPlan::Option RasterLightPlan::domes(const MethodPlan& material,
                                               const RenderSettings& settings,
                                               const std::string& method, int samples) const {
    const std::string count = method == "sampled"    ? passes
                              : method == "filtered" ? samplesOf(samples)
                                                     : "";
    const auto under = [&](const char* sky) {
        return predictLight(*material.probes, "domeLight", method, sky, count);
    };
    Option option{method, samples, 0.0, 0.0};
    if (_peak <= evenPeak * 1.2) {
        const LightPrediction even = under("constant");
        option.error = even.measured ? even.error : 1.0;
        option.ns = even.ns;
    } else {
        // Between the two skies by their peaks, and nothing better than the softer one.
        const LightPrediction soft = under("soft"), sun = under("sun");
        const double f = std::clamp((_peak - softPeak) / (sunPeak - softPeak), 0.0, 1.0);
        const double error = soft.error * (1.0 - f) + sun.error * f;
        const double more = method == "sampled" ? 1.0 : otherSkies;
        option.error =
            soft.measured && sun.measured ? std::min(more * std::max(soft.error, error), 1.0) : 1.0;
        option.ns = soft.ns;
    }
    if (method == "sampled") {
        const double noise = noiseBeside(std::min(material.error, methodShare * settings.tolerance),
                                         settings.tolerance);
        option.ns *= passesFor(option.error, noise, settings) / rowPasses;
        option.error = 0.0; // they converge
    } else {
        option.ns *= std::max(2, settings.minSamples);
    }
    return option;
}

RasterLightPlan::Option RasterLightPlan::areas(const MethodPlan& material,
                                               const std::string& method, bool& measured) const {
    Option option{method, 0, 0.0, 0.0};
    for (const std::string& shape : _areas) {
        const LightPrediction p =
            predictLight(*material.probes, "areaLight", method, shape,
                         method == "sampled" ? samplesOf(int(rowPasses)) : "");
        measured = measured && p.measured;
        option.error = std::max(option.error, p.error);
        option.ns = std::max(option.ns, p.ns);
    }
    return option;
}

std::vector<PlannedMethod> RasterLightPlan::choose(const MethodPlan& material,
                                                   const RenderSettings& settings,
                                                   bool transmits) const {
    std::vector<PlannedMethod> result;
    if (!(settings.tolerance >= 0.0) || !material.probes || material.probes->empty()) return result;
    const bool exact = settings.tolerance == 0.0 || transmits;
    double budget = std::max(methodShare * settings.tolerance - material.error, 0.0);
    const auto forced = [&](const std::string& point) { return settings.methods.count(point) > 0; };
    if (_hasDome && forced("domeLight")) {
        const std::string method = chosenMethod(settings.methods, "domeLight");
        const int samples = settings.environmentSamples > 0 ? settings.environmentSamples : 16;
        const Option o = domes(material, settings, method, samples);
        result.push_back(made("domeLight", method, o.error, o.ns, o.ns, true));
    } else if (_hasDome) {
        const Option sampled = domes(material, settings, "sampled", 0);
        Option best = sampled;
        const auto consider = [&](const char* method, int samples) {
            const Option o = domes(material, settings, method, samples);
            if (!exact && !_needsSamples && o.error <= budget && o.ns < best.ns) best = o;
        };
        const int asked = settings.environmentSamples;
        for (const int samples : {4, 16, 64, 256, 1024})
            if (asked <= 0 || samples == asked) consider("filtered", samples);
        if (asked <= 0 || asked >= 16)
            for (const char* method : {"prefiltered", "harmonics"})
                consider(method, std::max(asked, 16));
        budget -= best.error;
        result.push_back(made("domeLight", best.method, best.error, best.ns, sampled.ns, false));
        if (best.samples > 0)
            result.push_back(
                made("environmentSamples", std::to_string(best.samples), 0.0, 0.0, 0.0, asked > 0));
    }
    if (!_areas.empty()) {
        bool measured = true;
        Option sampled = areas(material, "sampled", measured);
        const double noise = noiseBeside(std::min(material.error, methodShare * settings.tolerance),
                                         settings.tolerance);
        sampled.ns *= passesFor(sampled.error, noise, settings) / rowPasses;
        sampled.error = 0.0;
        Option outlines = areas(material, "linearlyTransformedCosines", measured);
        outlines.ns *= std::max(2, settings.minSamples);
        const bool force = forced("areaLight");
        const bool wins =
            !exact && measured && outlines.error <= budget && outlines.ns < sampled.ns;
        const bool outlined =
            force ? chosenMethod(settings.methods, "areaLight") == outlines.method : wins;
        const Option& best = outlined ? outlines : sampled;
        result.push_back(made("areaLight", best.method, best.error, best.ns, sampled.ns, force));
    }
    return result;
}

} // namespace patina
