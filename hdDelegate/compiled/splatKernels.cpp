// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/splatKernels.h"

#include "hdDelegate/geometry/mortonOrder.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

mat3 rotationOf(const vec4& q) { // the real part first
    const float w = q.x, x = q.y, y = q.z, z = q.w;
    return mat3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
                2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
}

SplatKernel kernelOf(const SplatCloud& cloud, const dvec3& middle, size_t i) {
    const vec3 scale = cloud.scales.empty() ? vec3(1.0f) : cloud.scales[i];
    SplatKernel kernel;
    kernel.center = vec3(dvec3(cloud.positions[i]) - middle);
    kernel.opacity = cloud.opacities.empty() ? 1.0f : cloud.opacities[i];
    kernel.toUnit =
        cloud.orientations.empty() ? mat3(1.0f) : glm::transpose(rotationOf(cloud.orientations[i]));
    for (int column = 0; column < 3; ++column)
        kernel.toUnit[column] /= scale;
    kernel.reach = cloud.shape == SplatShape::ConstantSurflet
                       ? 1.0f
                       : 2.0f * std::log(kernel.opacity / shSplats::SPLAT_CUT);
    kernel.particle = uint32_t(i);
    kernel.shape = int32_t(cloud.shape);
    return kernel;
}

} // namespace

SplatKernels::SplatKernels(std::shared_ptr<const SplatCloud> cloud) : _cloud(std::move(cloud)) {
    std::vector<uint32_t> shown;
    shown.reserve(_cloud->positions.size());
    vec3 lower(INFINITY), upper(-INFINITY);
    for (size_t i = 0; i < _cloud->positions.size(); ++i) {
        if (!_cloud->opacities.empty() && !(_cloud->opacities[i] > shSplats::SPLAT_CUT)) continue;
        shown.push_back(uint32_t(i));
        lower = glm::min(lower, _cloud->positions[i]);
        upper = glm::max(upper, _cloud->positions[i]);
    }
    if (shown.empty()) return;
    _middle = 0.5 * (dvec3(lower) + dvec3(upper));
    std::vector<vec3> centers;
    for (const uint32_t i : shown)
        centers.push_back(vec3(dvec3(_cloud->positions[i]) - _middle));
    // Rays then find neighbours near each other in memory, too.
    const std::vector<uint32_t> order = mortonOrder(centers);
    _list.resize(shown.size());
    parallelFor(size_t(0), shown.size(),
                [&](size_t i) { _list[i] = kernelOf(*_cloud, _middle, shown[order[i]]); });
    for (const SplatKernel& kernel : _list) {
        const vec3 half = halfOf(kernel);
        _min = glm::min(_min, kernel.center - half);
        _max = glm::max(_max, kernel.center + half);
    }
}

vec3 SplatKernels::halfOf(const SplatKernel& kernel) const {
    const vec3 scale = _cloud->scales.empty() ? vec3(1.0f) : _cloud->scales[kernel.particle];
    const mat3 axes = _cloud->orientations.empty()
                          ? mat3(1.0f)
                          : rotationOf(_cloud->orientations[kernel.particle]);
    const float radius = std::sqrt(kernel.reach) * (1.0f + 1e-4f);
    vec3 half;
    for (int a = 0; a < 3; ++a)
        half[a] = radius * glm::length(vec3(axes[0][a], axes[1][a], axes[2][a]) * scale) +
                  4e-7f * std::abs(kernel.center[a]);
    return half;
}

vec3 SplatKernels::radiance(uint32_t kernel, const shSplats::SplatBasis& basis) const {
    constexpr vec3 grey(0.5f); // the offset of the method: harmonics are about it
    if (_cloud->harmonics.empty()) return grey;
    const size_t stride = _cloud->stride();
    const vec3* coefficients = &_cloud->harmonics[_list[kernel].particle * stride];
    vec3 sum = grey;
    for (size_t i = 0; i < std::min(stride, size_t(shSplats::SPLAT_BASIS)); ++i)
        sum += coefficients[i] * basis.at[i];
    return glm::max(sum, vec3(0.0f));
}

ColorTransformPtr transformOf(const Splats& prim, const RenderingSpace& space,
                              Diagnostics& diagnostics) {
    const ColorSpaces& spaces = ColorSpaces::shared();
    std::string name = prim.colorSpace;
    if (!name.empty() && ColorSpaces::isData(name)) return nullptr;
    if (!name.empty() && !spaces.toRec709(name)) {
        diagnostics.warn(prim.path, "colorSpace:name", messages::valuesSpaceUnknown(name));
        name.clear();
    }
    const auto transform = spaces.toRendering(name.empty() ? "lin_rec709" : name, space);
    return transform && !transform->isIdentity() ? transform : nullptr;
}

} // namespace patina
