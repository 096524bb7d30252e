// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/embree/wavelengths.h"

#include "shaders/shaders.h"

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

namespace patina {

namespace {

constexpr int firstNm = 380, bins = 400; // the range of sh::filmWavelength()

float chance(const vec3& sensitivity) {
    return (sensitivity.x + sensitivity.y + sensitivity.z) / 3.0f;
}

} // namespace

const Wavelengths& Wavelengths::of(const RenderingSpace& space) {
    static std::mutex mutex;
    static std::map<const RenderingSpace*, std::unique_ptr<const Wavelengths>> known;
    const std::lock_guard<std::mutex> lock(mutex);
    std::unique_ptr<const Wavelengths>& entry = known[&space];
    if (!entry) entry.reset(new Wavelengths(space));
    return *entry;
}

Wavelengths::Wavelengths(const RenderingSpace& space) {
    glm::dvec3 sum(0.0);
    for (int i = 0; i < bins; ++i) {
        const vec3 seen = space.from709(sh::filmChannels(float(firstNm + i) + 0.5f));
        _sensitivity.push_back(glm::max(seen, vec3(0.0f)));
        sum += glm::dvec3(_sensitivity.back());
    }
    double below = 0.0;
    for (vec3& s : _sensitivity) {
        s = vec3(glm::dvec3(s) / sum);
        _below.push_back(float(below));
        below += double(chance(s));
    }
    _below.push_back(1.0f);
}

Wavelengths::Drawn Wavelengths::draw(float u) const {
    const auto next = std::upper_bound(_below.begin(), _below.end() - 1, u);
    const size_t i = size_t(next - _below.begin()) - 1;
    const float width = _below[i + 1] - _below[i];
    const float f = width > 0.0f ? std::min((u - _below[i]) / width, 1.0f) : 0.5f;
    const float density = chance(_sensitivity[i]);
    return {float(firstNm + int(i)) + f, density > 0.0f ? _sensitivity[i] / density : vec3(0.0f)};
}

vec3 Wavelengths::sensitivity(float nm) const {
    const float bin = nm - float(firstNm);
    return bin >= 0.0f && bin < float(bins) ? _sensitivity[size_t(bin)] : vec3(0.0f);
}

} // namespace patina
