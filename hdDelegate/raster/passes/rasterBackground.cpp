// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/passes/rasterBackground.h"

#include "shaders/lights.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int rangeUniform = 17;

/// Half of the size of the box around a shape, in the shape's coordinates.
vec3 halfOf(int kind) {
    return shLights::shapeExtent(kind, {vec3(0.0f), mat3(1.0f), mat3(1.0f), 1.0f});
}

} // namespace

ShownLights shownLight(const GpuLight& light, const mat4& worldToClip, int width, int height) {
    ShownLights all;
    all.count = 1;
    all.width = width;
    all.height = height;
    all.near = all.beyond = true;
    const vec3 half = halfOf(light.kind);
    vec4 corners[8];
    float deepest = 0.0f;
    for (int i = 0; i < 8; ++i) {
        const vec3 q =
            half * vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
        const vec3 p = light.origin + light.axis0 * q.x + light.axis1 * q.y + light.axis2 * q.z;
        corners[i] = worldToClip * vec4(p, 1.0f);
        const float sum = corners[i].x + corners[i].y + corners[i].z + corners[i].w;
        if (!std::isfinite(sum)) return all;
        deepest = std::max(deepest, corners[i].w);
    }
    ShownLights out = all;
    out.width = out.height = 0;
    if (!(deepest > 0.0f)) return out; // behind the camera
    vec3 low(INFINITY), high(-INFINITY);
    for (const vec4& c : corners) {
        if (c.w < 1e-4f * deepest) return all;
        low = glm::min(low, vec3(c) / c.w);
        high = glm::max(high, vec3(c) / c.w);
    }
    // Rounding moves the borders by far less than a pixel.
    const auto pixels = [](float from, float to, int size, int& first, int& count) {
        const auto at = [&](float x, float beside) {
            const float p = (0.5f * x + 0.5f) * float(size) + beside;
            return int(std::clamp(p, 0.0f, float(size)));
        };
        first = at(from, -1.0f);
        count = at(to, 2.0f) - first;
    };
    pixels(low.x, high.x, width, out.left, out.width);
    pixels(low.y, high.y, height, out.bottom, out.height);
    if (out.width <= 0 || out.height <= 0) out.width = out.height = 0;
    const float slack = 1e-5f;
    out.near = low.z < -1.0f + slack;
    out.beyond = high.z > 1.0f - slack;
    return out;
}

void RasterBackground::draw(const SampledLights& sampled, const RasterView& view, int width,
                            int height) {
    std::vector<GpuLight> domes, together, alone;
    ShownLights group;
    std::vector<ShownLights> singles;
    int right = 0, top = 0;
    for (size_t i = 0; i < sampled.lights.size(); ++i) {
        const GpuLight& light = sampled.lights[i];
        // Further samples of a light that is among them.
        if (int(i) >= sampled.found && int(i) < sampled.taken) continue;
        if (!light.is(shLights::LIGHT_IS_SEEN) || light.kind > shLights::LIGHT_DOME) continue;
        if (light.kind == shLights::LIGHT_DOME) {
            domes.push_back(light);
            continue;
        }
        if (light.is(shLights::LIGHT_IS_DELTA) || light.kind >= shLights::LIGHT_POINT) continue;
        ShownLights shown = shownLight(light, view.worldToClip, width, height);
        if (shown.width == 0) continue;
        if (shown.alone()) {
            alone.push_back(light);
            singles.push_back(shown);
            continue;
        }
        const bool first = together.empty();
        together.push_back(light);
        group.left = first ? shown.left : std::min(group.left, shown.left);
        group.bottom = first ? shown.bottom : std::min(group.bottom, shown.bottom);
        right = std::max(right, shown.left + shown.width);
        top = std::max(top, shown.bottom + shown.height);
    }
    group.width = right - group.left;
    group.height = top - group.bottom;
    group.first = int(domes.size());
    group.count = int(together.size());
    std::vector<GpuLight> lights = domes;
    lights.insert(lights.end(), together.begin(), together.end());
    lights.insert(lights.end(), alone.begin(), alone.end());
    _lights = GlBuffer(lights);
    _lights.bindStorage(4);
    // What is cleared is what a sky without domes looks like.
    if (!domes.empty()) {
        _sky->use();
        gl.Uniform4i(rangeUniform, 0, int(domes.size()), 0, 0);
        gl.DepthFunc(GL_LEQUAL);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    }
    if (together.empty() && alone.empty()) return;
    _shapes->use();
    gl.Enable(GL_SCISSOR_TEST);
    const auto show = [](const ShownLights& s) {
        gl.Scissor(s.left, s.bottom, s.width, s.height);
        gl.Uniform4i(rangeUniform, s.first, s.count, 0, 0);
        gl.DrawArrays(GL_TRIANGLES, 0, 3);
    };
    // Depths of what is before or behind the range are all the same: these lights are compared by
    // distance, all in one draw. The others are compared by depth.
    gl.DepthFunc(GL_LEQUAL);
    if (!together.empty()) show(group);
    gl.DepthFunc(GL_LESS);
    for (size_t i = 0; i < singles.size(); ++i) {
        singles[i].first = group.first + group.count + int(i);
        show(singles[i]);
    }
    gl.Disable(GL_SCISSOR_TEST);
}

} // namespace patina
