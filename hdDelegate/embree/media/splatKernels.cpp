// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/media/splatKernels.h"

#include "hdDelegate/geometry/mortonOrder.h"
#include "hdDelegate/parallel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

bool goesOn(void* stop, double) {
    return !*static_cast<const std::atomic<bool>*>(stop);
}

mat3 rotationOf(const vec4& q) { // the real part first
    const float w = q.x, x = q.y, y = q.z, z = q.w;
    return mat3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y),
                2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x),
                2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
}

SplatKernels::Kernel kernelOf(const SplatCloud& cloud, const dvec3& middle, size_t i) {
    const vec3 scale = cloud.scales.empty() ? vec3(1.0f) : cloud.scales[i];
    SplatKernels::Kernel kernel;
    kernel.center = vec3(dvec3(cloud.positions[i]) - middle);
    kernel.opacity = cloud.opacities.empty() ? 1.0f : cloud.opacities[i];
    kernel.toUnit =
        cloud.orientations.empty() ? mat3(1.0f) : glm::transpose(rotationOf(cloud.orientations[i]));
    for (int column = 0; column < 3; ++column)
        kernel.toUnit[column] /= scale;
    kernel.reach = kernel.opacity > splatCut ? 2.0f * std::log(kernel.opacity / splatCut) : 0.0f;
    kernel.particle = uint32_t(i);
    return kernel;
}

} // namespace

void SplatQuery::add(const SplatHit& hit, float& far) {
    if (sums) {
        constexpr double most = 64.0; // of one kernel; far beyond splatEnd
        depth += int64_t(std::min(-std::log1p(-double(hit.alpha)), most) * perUnit);
        if (double(depth) > -std::log(double(splatEnd)) * perUnit) far = -INFINITY;
        return;
    }
    if (!after.isBefore(hit)) return;
    if (count == most && !hit.isBefore(hits[most - 1])) return;
    int i = count < most ? count++ : most - 1;
    for (; i > 0 && hit.isBefore(hits[i - 1]); --i)
        hits[i] = hits[i - 1];
    hits[i] = hit;
    // What a ray enters behind the last hit is densest behind it, too; but for rounding.
    if (count == most) far = hits[most - 1].distance * (1.0f + slack);
}

SplatKernels::SplatKernels(RTCDevice device, std::shared_ptr<const SplatCloud> cloud,
                           const std::atomic<bool>& stop)
    : _cloud(std::move(cloud)) {
    const size_t count = _cloud->positions.size();
    std::vector<uint32_t> shown;
    shown.reserve(count);
    vec3 lower(INFINITY), upper(-INFINITY);
    for (size_t i = 0; i < count; ++i) {
        if (!_cloud->opacities.empty() && !(_cloud->opacities[i] > splatCut)) continue;
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
    _kernels.resize(shown.size());
    parallelFor(size_t(0), shown.size(),
                [&](size_t i) { _kernels[i] = kernelOf(*_cloud, _middle, shown[order[i]]); });

    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(_kernels.size()));
    rtcSetGeometryMask(geometry, ~0u);
    rtcSetGeometryUserData(geometry, this);
    rtcSetGeometryBoundsFunction(geometry, boundsOf, nullptr);
    rtcSetGeometryIntersectFunction(geometry, meet);
    rtcCommitGeometry(geometry);
    _scene = rtcNewScene(device);
    rtcSetSceneFlags(_scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneProgressMonitorFunction(_scene, goesOn, const_cast<std::atomic<bool>*>(&stop));
    rtcAttachGeometry(_scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(_scene);
    rtcSetSceneProgressMonitorFunction(_scene, nullptr, nullptr);
}

SplatKernels::~SplatKernels() {
    if (_scene) rtcReleaseScene(_scene);
}

RTCBounds SplatKernels::bounds() const {
    RTCBounds bounds;
    rtcGetSceneBounds(_scene, &bounds);
    return bounds;
}

size_t SplatKernels::bytes() const {
    return _kernels.capacity() * sizeof(Kernel);
}

void SplatKernels::boundsOf(const RTCBoundsFunctionArguments* args) {
    const auto& self = *static_cast<const SplatKernels*>(args->geometryUserPtr);
    const Kernel& kernel = self._kernels[args->primID];
    const SplatCloud& cloud = *self._cloud;
    const vec3 scale = cloud.scales.empty() ? vec3(1.0f) : cloud.scales[kernel.particle];
    const mat3 axes =
        cloud.orientations.empty() ? mat3(1.0f) : rotationOf(cloud.orientations[kernel.particle]);
    // Wider by what rounding of a ray may take: the point that is densest has to be inside.
    const float radius = std::sqrt(kernel.reach) * (1.0f + 1e-4f);
    vec3 half;
    for (int a = 0; a < 3; ++a)
        half[a] = radius * glm::length(vec3(axes[0][a], axes[1][a], axes[2][a]) * scale) +
                  4e-7f * std::abs(kernel.center[a]);
    const vec3 lower = kernel.center - half, upper = kernel.center + half;
    RTCBounds& b = *args->bounds_o;
    b.lower_x = lower.x, b.lower_y = lower.y, b.lower_z = lower.z;
    b.upper_x = upper.x, b.upper_y = upper.y, b.upper_z = upper.z;
}

void SplatKernels::meet(const RTCIntersectFunctionNArguments* args) {
    if (!args->valid[0]) return;
    const auto& self = *static_cast<const SplatKernels*>(args->geometryUserPtr);
    auto& query = *reinterpret_cast<SplatQuery*>(args->context);
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    const Kernel& kernel = self._kernels[args->primID];
    const vec3 origin = vec3(ray.org_x, ray.org_y, ray.org_z) - kernel.center;
    const vec3 direction(ray.dir_x, ray.dir_y, ray.dir_z);
    // From the point nearest to the middle, so that no digits are lost on a long way.
    const float nearest = -glm::dot(origin, direction) / glm::dot(direction, direction);
    const vec3 start = kernel.toUnit * (origin + direction * nearest);
    const vec3 step = kernel.toUnit * direction;
    const float further = -glm::dot(start, step) / glm::dot(step, step);
    const vec3 densest = start + step * further;
    const float away = glm::dot(densest, densest);
    if (!(away < kernel.reach)) return;
    const float distance = nearest + further;
    if (!(distance >= ray.tnear) || !(distance <= ray.tfar)) return;
    query.add({distance, kernel.opacity * std::exp(-0.5f * away), query.place, args->primID},
              ray.tfar);
}

vec3 SplatKernels::radiance(uint32_t kernel, const float* basis) const {
    constexpr vec3 grey(0.5f); // the offset of the method: harmonics are about it
    if (_cloud->harmonics.empty()) return grey;
    const size_t stride = _cloud->stride();
    const vec3* coefficients = &_cloud->harmonics[_kernels[kernel].particle * stride];
    vec3 sum = grey;
    for (size_t i = 0; i < std::min<size_t>(stride, splatBasisSize); ++i)
        sum += coefficients[i] * basis[i];
    return glm::max(sum, vec3(0.0f));
}

void splatBasis(const vec3& d, float basis[splatBasisSize]) {
    const float x = d.x, y = d.y, z = d.z, xx = x * x, yy = y * y, zz = z * z;
    basis[0] = 0.28209479f;
    basis[1] = -0.48860251f * y;
    basis[2] = 0.48860251f * z;
    basis[3] = -0.48860251f * x;
    basis[4] = 1.09254843f * x * y;
    basis[5] = -1.09254843f * y * z;
    basis[6] = 0.31539157f * (2.0f * zz - xx - yy);
    basis[7] = -1.09254843f * x * z;
    basis[8] = 0.54627422f * (xx - yy);
    basis[9] = -0.59004359f * y * (3.0f * xx - yy);
    basis[10] = 2.89061144f * x * y * z;
    basis[11] = -0.45704579f * y * (4.0f * zz - xx - yy);
    basis[12] = 0.37317633f * z * (2.0f * zz - 3.0f * xx - 3.0f * yy);
    basis[13] = -0.45704579f * x * (4.0f * zz - xx - yy);
    basis[14] = 1.44530572f * z * (xx - yy);
    basis[15] = -0.59004359f * x * (xx - 3.0f * yy);
}

} // namespace patina
