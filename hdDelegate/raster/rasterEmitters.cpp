#include "hdDelegate/raster/rasterEmitters.h"

#include <algorithm>
#include <cmath>

namespace patina {

void RasterEmitters::clear() {
    _emitters.clear();
    _sums.clear();
}

void RasterEmitters::add(const TriangleMesh& mesh, size_t subset, const MaterialProgram& program,
                         const RasterMeshLight& light, const mat4& toWorld, int category,
                         const vec3& origin) {
    const bool glows = program.hasEmission();
    if (!glows && light.mode == RasterMeshLight::None) return;
    const bool mirrored = glm::determinant(mat3(toWorld)) < 0.0f;
    for (size_t t = 0; t < mesh.triangles.size() && _emitters.size() < maxTriangles; ++t) {
        const size_t own = t < mesh.triangleSubset.size() ? mesh.triangleSubset[t] : 0;
        if (own != subset) continue;
        vec3 p[3];
        for (int k = 0; k < 3; ++k)
            p[k] = vec3(toWorld * vec4(mesh.positions[0][mesh.triangles[t][k]], 1.0f));
        RasterEmitter e;
        e.corner = p[0];
        e.edge1 = p[1] - p[0];
        e.edge2 = p[2] - p[0];
        vec3 ng = glm::cross(e.edge1, e.edge2);
        e.area = 0.5f * glm::length(ng);
        if (!(e.area > 0.0f) || !std::isfinite(e.area)) continue;
        if (mirrored) {
            std::swap(e.edge1, e.edge2);
            ng = -ng;
        }
        e.category = category;
        e.twoSided = glows;
        ShadingPoint point;
        point.position = point.objectPosition = origin + (p[0] + p[1] + p[2]) / 3.0f;
        point.geometricNormal = point.normal = point.viewDirection = glm::normalize(ng);
        const vec3 glow = glows ? program.emission(point, point.viewDirection) : vec3(0.0f);
        switch (light.mode) {
        case RasterMeshLight::None: e.radiance = glow; break;
        case RasterMeshLight::Tints:
            e.radiance = glows ? light.radiance * glow : light.radiance;
            e.twoSided = false;
            break;
        case RasterMeshLight::Adds: e.radiance = light.radiance + glow; break;
        case RasterMeshLight::Alone:
            e.radiance = light.radiance;
            e.twoSided = false;
            break;
        }
        e.radiance = glm::max(e.radiance, vec3(0.0f));
        const double power = double(e.area) * glm::dot(e.radiance, vec3(0.2126f, 0.7152f, 0.0722f));
        if (!(power > 0.0) || !std::isfinite(power)) continue;
        _sums.push_back((_sums.empty() ? 0.0 : _sums.back()) + power);
        _emitters.push_back(e);
    }
}

const RasterEmitter& RasterEmitters::choose(float u, float& within, float& chance) const {
    const double at = double(u) * _sums.back();
    const size_t i = std::min(
        size_t(std::upper_bound(_sums.begin(), _sums.end(), at) - _sums.begin()), _sums.size() - 1);
    const double before = i > 0 ? _sums[i - 1] : 0.0, own = _sums[i] - before;
    within = std::clamp(float((at - before) / own), 0.0f, 0.9999999f);
    chance = float(own / _sums.back());
    return _emitters[i];
}

} // namespace patina
