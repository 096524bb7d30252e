// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/lights/rasterLightFilters.h"

#include "hdDelegate/scene/lightUnits.h"

#include <algorithm>

namespace patina {

namespace {

constexpr int largestImage = 1024; ///< texels along a side; larger ones are averaged

static_assert(int(LightFilterType::Barn) == shLights::FILTER_BARN &&
              int(LightFilterType::Cookie) == shLights::FILTER_COOKIE &&
              int(LightFilterType::Gobo) == shLights::FILTER_GOBO &&
              int(LightFilterType::Multiplier) == shLights::FILTER_MULTIPLIER &&
              int(LightFilterType::Ramp) == shLights::FILTER_RAMP &&
              int(LightFilterType::Rod) == shLights::FILTER_ROD);

int addCurve(const LightFilters::Curve& curve, RasterLightTables& tables) {
    std::vector<vec4> knots;
    for (size_t i = 0; i < curve.knots.size(); ++i)
        knots.emplace_back(curve.values[i], curve.knots[i]);
    return tables.add(knots);
}

vec4 curveRow(const LightFilters::Curve& curve, RasterLightTables& tables) {
    return vec4(float(addCurve(curve, tables)), float(curve.knots.size()), float(curve.kind), 0.0f);
}

} // namespace

/// @returns the first texel in the tables, and the size there
int RasterLightFilters::image(const std::shared_ptr<const ImageRGB>& image,
                              RasterLightTables& tables, int& width, int& height) {
    auto known = std::find_if(_images.begin(), _images.end(),
                              [&](const Shown& shown) { return shown.image == image; });
    if (known == _images.end()) {
        const int across = (image->width + largestImage - 1) / largestImage;
        const int down = (image->height + largestImage - 1) / largestImage;
        Shown shown{image, 0, image->width / across, image->height / down};
        std::vector<vec4> texels;
        for (int y = 0; y < shown.height; ++y)
            for (int x = 0; x < shown.width; ++x) {
                const int x1 = (x + 1) * image->width / shown.width;
                const int y1 = (y + 1) * image->height / shown.height;
                vec3 sum(0.0f);
                float count = 0.0f;
                for (int j = y * image->height / shown.height; j < y1; ++j)
                    for (int i = x * image->width / shown.width; i < x1; ++i, ++count)
                        sum += image->pixels[size_t(j) * size_t(image->width) + size_t(i)];
                texels.emplace_back(sum / count, 0.0f);
            }
        shown.first = tables.add(texels);
        _images.push_back(shown);
        known = std::prev(_images.end());
    }
    width = known->width;
    height = known->height;
    return known->first;
}

int RasterLightFilters::add(const Light& light, const RasterPlace& place, float timeCode,
                            LightImages& images, RasterLightTables& tables,
                            Diagnostics& diagnostics) {
    if (light.filters.empty()) return -1;
    Light still = light;
    for (LightFilter& f : still.filters)
        f.transform = place.groupToWorld * exactTransformAt(f.transform, timeCode);
    const LightFilters all(still, mat4(1.0f), dvec3(0.0), timeCode, images, diagnostics);
    std::vector<vec4> rows;
    bool fits = true;
    for (const LightFilters::Filter& f : all.filters()) {
        const bool more = &f != &all.filters().back();
        const int flags = (f.invert ? shLights::FILTER_INVERT : 0) |
                          (f.analytic ? shLights::FILTER_ANALYTIC : 0) |
                          (f.directional ? shLights::FILTER_DIRECTIONAL : 0) |
                          (more ? shLights::FILTER_MORE : 0);
        rows.emplace_back(float(f.type), float(flags), f.density, f.intensity);
        const mat4 byRows = glm::transpose(f.toFilter);
        for (int i = 0; i < 3; ++i)
            rows.push_back(byRows[i]);
        if (f.type == LightFilterType::Ramp) {
            rows.emplace_back(float(f.rampType), f.start, f.end, 0.0f);
            for (const LightFilters::Curve* curve : {&f.ramp, &f.colors}) {
                rows.push_back(curveRow(*curve, tables));
                fits &= rows.back().x >= 0.0f;
            }
            rows.emplace_back(0.0f);
        } else if (f.image) {
            int width, height;
            const int first = image(f.image, tables, width, height);
            fits &= first >= 0;
            rows.emplace_back(f.shown.size.x, f.shown.size.y, f.shown.center.x, f.shown.center.y);
            rows.emplace_back(f.fill, f.apex);
            rows.emplace_back(float(f.shown.wrap), float(width), float(height), f.shear.x);
            rows.emplace_back(float(first), 0.0f, 0.0f, f.shear.y);
        } else {
            rows.emplace_back(f.box.low, f.box.radius);
            rows.emplace_back(f.box.high, f.apex);
            rows.emplace_back(f.box.edgeLow, f.shear.x);
            rows.emplace_back(f.box.edgeHigh, f.shear.y);
        }
    }
    if (rows.empty()) return -1;
    const int first = fits ? tables.add(rows) : -1;
    if (first < 0) diagnostics.warn(light.path, "light:filters", messages::filtersWithoutRoom);
    return first;
}

void RasterLightFilters::addMesh(const Light& light, const std::vector<RasterPlace>& places,
                                 float timeCode, LightImages& images, RasterLightTables& tables,
                                 Diagnostics& diagnostics) {
    if (light.filters.empty()) return;
    OfMesh& of = _meshes[light.path];
    std::vector<vec4> table;
    for (const RasterPlace& place : places) {
        of.places.push_back(add(light, place, timeCode, images, tables, diagnostics));
        table.emplace_back(float(of.places.back()), 0.0f, 0.0f, 0.0f);
    }
    of.table = tables.add(table);
    if (of.table < 0) {
        diagnostics.warn(light.path, "light:filters", messages::filtersWithoutRoom);
        of.places.clear();
    }
}

int RasterLightFilters::ofMesh(const std::string& light, size_t place) const {
    const auto found = _meshes.find(light);
    return found != _meshes.end() && place < found->second.places.size()
               ? found->second.places[place]
               : -1;
}

int RasterLightFilters::tableOfMesh(const std::string& light) const {
    const auto found = _meshes.find(light);
    return found != _meshes.end() ? found->second.table : -1;
}

} // namespace patina
