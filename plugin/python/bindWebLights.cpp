// SPDX-License-Identifier: Apache-2.0
// Lights of a scene, as the material page takes them.

#include "hdDelegate/geometry/tessellate.h"
#include "hdDelegate/lights/environmentMap.h"
#include "hdDelegate/lights/lightFields.h"
#include "hdDelegate/lights/lightImages.h"
#include "hdDelegate/lights/resolvedLight.h"
#include "hdDelegate/scene/lightUnits.h"
#include "hdDelegate/scene/scene.h"
#include "base/maths.h"
#include "plugin/python/warningList.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace py = pybind11;

namespace patina {

namespace {

constexpr int largestImage = 128;          ///< of rect lights, texels along a side
constexpr int domeWidth = 512;             ///< of domes that are no latlong maps
constexpr size_t maxTriangles = 4096;      ///< of a mesh light
constexpr size_t largestTable = 1u << 20u; ///< texels

/// Facts about lights that the page tells its user.
struct WebLights {
    std::vector<vec4> table; ///< values that rows point into
    Diagnostics diagnostics;
    LightImages images{diagnostics};
    py::list direct, domes;
};

std::array<float, 3> triple(const vec3& v) {
    return {v.x, v.y, v.z};
}

vec3 notNegative(const Light& light, const vec3& radiance, WebLights& out) {
    const vec3 kept = glm::max(radiance, vec3(0.0f));
    if (kept != radiance) out.diagnostics.warn("", "", messages::pageLightNegative(light.path));
    return kept;
}

/// A rect's image, means over its cells, top row first.
void addImage(const Light& light, LightFields& row, WebLights& out) {
    const auto image = out.images.image(light);
    const int w = std::clamp(image->width, 1, largestImage);
    const int h = std::clamp(image->height, 1, largestImage);
    row.firstValue = int(out.table.size());
    row.columns = w;
    row.rows = h;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            vec3 sum(0.0f);
            const int x0 = x * image->width / w, x1 = std::max((x + 1) * image->width / w, x0 + 1);
            const int y0 = y * image->height / h,
                      y1 = std::max((y + 1) * image->height / h, y0 + 1);
            for (int k = y0; k < y1; ++k)
                for (int i = x0; i < x1; ++i)
                    sum += image->pixels[size_t(k) * size_t(image->width) + size_t(i)];
            // Samples are even over the rect: they have the density 1 beside even ones.
            out.table.emplace_back(glm::max(sum / float((x1 - x0) * (y1 - y0)), vec3(0.0f)), 1.0f);
        }
}

void addProfile(const Light& light, LightFields& row, WebLights& out) {
    const auto profile = lightProfile(light, out.diagnostics);
    if (!profile) return;
    const ProfileGrid grid = profileGrid(light, *profile, 181, 37);
    row.firstProfile = int(out.table.size());
    row.profileThetas = grid.thetas;
    row.profilePhis = grid.phis;
    for (float value : grid.values)
        out.table.emplace_back(value, 0.0f, 0.0f, 0.0f);
}

/// The largest triangles of the mesh that a light belongs to: corner and running share of the area,
/// and two edges, one of them with the normal's side.
bool addTriangles(const Scene& scene, const Light& light, LightFields& row, WebLights& out) {
    const auto state = scene.snapshot();
    const auto found = state->geometry.find(light.geometry.empty() ? light.path : light.geometry);
    if (found == state->geometry.end() || found->second->kind != GeometryKind::Mesh) return false;
    TessellationOptions options;
    options.triangleBudget = 100000;
    const TriangleMesh mesh =
        tessellate(static_cast<const Mesh&>(*found->second), options, out.diagnostics);
    const mat4 toWorld = transformAt(found->second->transform, 0.0f);
    const bool mirrored = glm::determinant(mat3(toWorld)) < 0.0f;
    struct Triangle {
        vec3 corner, edge1, edge2;
        float area;
    };
    std::vector<Triangle> all;
    double whole = 0.0, kept = 0.0;
    for (const auto& t : mesh.triangles) {
        vec3 p[3];
        for (int c = 0; c < 3; ++c)
            p[c] = vec3(toWorld * vec4(mesh.positions[0][t[c]], 1.0f));
        const vec3 e1 = p[mirrored ? 2 : 1] - p[0], e2 = p[mirrored ? 1 : 2] - p[0];
        const float area = 0.5f * glm::length(glm::cross(e1, e2));
        if (!(area > 0.0f) || !std::isfinite(area)) continue;
        all.push_back({p[0], e1, e2, area});
        whole += double(area);
    }
    if (all.empty()) return false;
    if (all.size() > maxTriangles) {
        std::nth_element(all.begin(), all.begin() + maxTriangles, all.end(),
                         [](const Triangle& a, const Triangle& b) { return a.area > b.area; });
        all.resize(maxTriangles);
        out.diagnostics.warn("", "", messages::pageLightOfMesh(light.path));
    }
    for (const Triangle& t : all)
        kept += double(t.area);
    row.firstValue = int(out.table.size());
    row.columns = int(all.size());
    row.density = float(1.0 / kept);
    double sum = 0.0;
    for (const Triangle& t : all) {
        sum += double(t.area);
        out.table.emplace_back(t.corner, float(sum / kept));
        out.table.emplace_back(t.edge1, 0.0f);
        out.table.emplace_back(t.edge2, 0.0f);
    }
    vec3 radiance = notNegative(light, lightBaseRadiance(light), out);
    if (light.normalize) radiance /= float(whole);
    row.radiance = radiance * float(whole / kept);
    return true;
}

/// A row of the texture of shaders/web/lights.glsl.
std::vector<float> texelsOf(const LightFields& row) {
    std::vector<float> floats;
#define PATINA_ROW(vector, type, number, initial)                                                  \
    floats.insert(floats.end(), {row.vector.x, row.vector.y, row.vector.z, float(row.number)});
#define PATINA_NUMBERS(type, a, b, c, d, initial)                                                  \
    floats.insert(floats.end(), {float(row.a), float(row.b), float(row.c), float(row.d)});
#include "shaders/lights/fields.glsl"
#undef PATINA_ROW
#undef PATINA_NUMBERS
    return floats;
}

/// The texels of a light; empty for one that gives none.
std::vector<float> lightRow(const Scene& scene, const Light& light, const mat4& toWorld,
                            WebLights& out) {
    LightFields row;
    if (light.type == LightType::Mesh) {
        if (!addTriangles(scene, light, row, out)) return {};
        row.kind = shLights::LIGHT_MESH;
        row.set(shLights::LIGHT_AT_PLACE);
        row.diffuse = light.diffuse;
        row.specular = light.specular;
        row.setShaping(LightShaping(light, toWorld, nullptr));
    } else {
        ResolvedLight is = resolveLight(light, toWorld, out.diagnostics);
        if (is.kind == ResolvedLight::Kind::None || is.kind == ResolvedLight::Kind::Dome) return {};
        row.radiance = notNegative(light, is.radiance, out);
        // Densities of narrow cones have no square in floats: those shine from one direction.
        if (is.kind == ResolvedLight::Kind::Distant && is.versine < 1e-6f && !is.delta) {
            row.radiance *= float(lightSizeFactor(light, toWorld));
            is.versine = 0.0f;
            is.delta = true;
        }
        row.setLight(light, is, lightPose(light, is.kind, toWorld, nullptr));
        if (row.kind == shLights::SHAPE_RECT && light.hasImage()) addImage(light, row, out);
        addProfile(light, row, out);
    }
    const std::vector<float> texels = texelsOf(row);
    const auto isFinite = [](float x) { return std::isfinite(x); };
    return std::all_of(texels.begin(), texels.end(), isFinite) ? texels : std::vector<float>();
}

/// The image of a dome as a latlong map; none where it is one already.
py::object latlongOf(const Light& light, WebLights& out) {
    const EnvironmentFormat format = environmentFormat(light.textureFormat);
    const bool network = !light.network.empty();
    if (!light.hasImage() || (!network && format == EnvironmentFormat::Latlong)) return py::none();
    if (!network && format == EnvironmentFormat::Automatic) {
        const auto image = out.images.image(light);
        if (image->width * 4 != image->height * 3) return py::none();
    }
    const auto map = out.images.environment(light);
    py::array_t<float> pixels(std::vector<size_t>{domeWidth / 2, domeWidth, 3});
    float* to = pixels.mutable_data();
    for (int y = 0; y < domeWidth / 2; ++y)
        for (int x = 0; x < domeWidth; ++x) {
            vec3 sum(0.0f);
            for (int k = 0; k < 4; ++k) {
                const float u = (float(x) + 0.25f + 0.5f * float(k % 2)) / float(domeWidth);
                const float v = (float(y) + 0.25f + 0.5f * float(k / 2)) * 2.0f / float(domeWidth);
                sum += map->radiance(shLights::domeDirection(vec2(u, v)));
            }
            for (int c = 0; c < 3; ++c)
                *to++ = 0.25f * sum[c];
        }
    return pixels;
}

void addLight(const Scene& scene, const std::string& path, const Light& light, WebLights& out) {
    const mat4 toWorld = transformAt(light.transform, 0.0f);
    if (light.type == LightType::Dome) {
        py::dict dome;
        dome["path"] = path;
        dome["texture"] = light.textureFile;
        constexpr size_t most = 64; // beyond what a page shows, images are not worth their memory
        dome["pixels"] = out.domes.size() < most ? py::object(latlongOf(light, out)) : py::none();
        dome["radiance"] =
            triple(notNegative(light, resolveLight(light, toWorld, out.diagnostics).radiance, out));
        dome["axes"] = std::vector<std::array<float, 3>>{
            triple(vec3(toWorld[0])), triple(vec3(toWorld[1])), triple(vec3(toWorld[2]))};
        out.domes.append(dome);
        return;
    }
    const size_t before = out.table.size();
    const std::vector<float> row = lightRow(scene, light, toWorld, out);
    if (row.empty() || out.table.size() > largestTable) {
        out.table.resize(std::min(before, out.table.size()));
        out.diagnostics.warn("", "",
                             row.empty() ? messages::pageLightDark(path)
                                         : messages::pageLightTooLarge(path));
        return;
    }
    out.direct.append(py::make_tuple(path, row));
}

std::vector<std::string> lightMeshes(const Scene& scene) {
    std::vector<std::string> paths;
    for (const auto& [path, light] : scene.snapshot()->lights)
        if (light->type == LightType::Mesh)
            paths.push_back(light->geometry.empty() ? path : light->geometry);
    return paths;
}

py::dict lightsOf(const Scene& scene) {
    WebLights out;
    for (const auto& [path, light] : scene.snapshot()->lights) {
        if (!light->visible) continue;
        if (!light->group.empty())
            out.diagnostics.warn("", "", messages::pageLightOfInstances(path));
        else
            addLight(scene, path, *light, out);
    }
    py::array_t<float> table(std::vector<size_t>{out.table.size(), 4});
    if (!out.table.empty())
        std::copy_n(&out.table[0].x, 4 * out.table.size(), table.mutable_data());
    py::dict dict;
    dict["lights"] = out.direct;
    dict["domes"] = out.domes;
    dict["table"] = table;
    dict["warnings"] = warningList(out.diagnostics);
    return dict;
}

} // namespace

void bindWebLights(py::module_& m) {
    m.def("web_light_meshes", &lightMeshes, py::arg("scene"), "Paths of meshes that are lights.");
    m.def("web_lights", &lightsOf, py::arg("scene"),
          "lights: (path, floats in the layout of shaders/lights/fields.glsl); table: the values "
          "(n, 4) that they point into; domes: dicts of path, texture, radiance, axes and, where "
          "the image is no latlong map, pixels of one; warnings: of what is left out.");
}

} // namespace patina
