// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"
#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr int highestDegree = 3;
constexpr int largestDegree = 64;  // beyond it a number is no degree
constexpr float thinnest = 1e-4f;  // of a kernel's largest scale: rays are traced in floats
constexpr float flat = 1e-3f;      // of the larger scale of a flat kernel
constexpr float smallest = 1e-15f; // scale, so that its inverse is within largestPlace

bool isPlain(const vec3& v) {
    return std::abs(v.x) <= largestPlace && std::abs(v.y) <= largestPlace &&
           std::abs(v.z) <= largestPlace;
}

/// Checks the arrays of one cloud.
class Checker {
public:
    Checker(SplatCloud& cloud, const std::string& path, Diagnostics& diagnostics)
        : _cloud(cloud), _count(cloud.positions.size()), _path(path), _diagnostics(diagnostics) {}

    void run() {
        setDegree();
        fit(_cloud.orientations, "orientations");
        fit(_cloud.scales, "scales");
        fit(_cloud.opacities, "opacities");
        fit(_cloud.harmonics, harmonics, _cloud.stride());
        if (_cloud.harmonics.empty()) _cloud.degree = 0;
        clampOpacities();
        turn();
        size();
        dropBroken();
    }

private:
    static constexpr const char* harmonics = "radiance:sphericalHarmonicsCoefficients";

    void warn(const char* input, const Message& message) {
        _diagnostics.warn(_path, input, message);
    }
    void setDegree() {
        constexpr const char* input = "radiance:sphericalHarmonicsDegree";
        if (_cloud.degree < 0 || _cloud.degree > largestDegree) {
            warn(input, messages::splatDegree(_cloud.degree));
            _cloud.degree = 0;
            _cloud.harmonics.clear();
        } else if (_cloud.degree > highestDegree) {
            warn(input, messages::splatDegreeHigh(_cloud.degree));
        }
    }
    template <class T> void fit(std::vector<T>& values, const char* input, size_t stride = 1) {
        const size_t needed = _count * stride;
        if (values.empty() || values.size() == needed) return;
        if (values.size() > needed) {
            warn(input, messages::splatValuesTooMany(values.size(), needed));
            values.resize(needed);
        } else {
            warn(input, messages::splatValuesTooFew(values.size(), needed));
            values.clear();
        }
    }
    void clampOpacities() {
        size_t outside = 0;
        for (float& opacity : _cloud.opacities) {
            const float inside = std::clamp(opacity, 0.0f, 1.0f);
            if (std::isnan(opacity) || inside == opacity) continue;
            opacity = inside;
            ++outside;
        }
        if (outside) warn("opacities", messages::splatOpacities(outside));
    }
    void turn() {
        size_t without = 0;
        for (vec4& q : _cloud.orientations) {
            const glm::dvec4 exact(q);
            const double length = std::sqrt(glm::dot(exact, exact));
            if (std::isnan(length)) continue;
            if (std::isfinite(length) && length > 0.0) {
                q = vec4(exact / length);
            } else {
                q = vec4(1.0f, 0.0f, 0.0f, 0.0f);
                ++without;
            }
        }
        if (without) warn("orientations", messages::splatTurns(without));
    }
    void size() {
        size_t mended = 0, without = 0;
        for (size_t i = 0; i < _cloud.scales.size(); ++i) {
            vec3& scale = _cloud.scales[i];
            // Of flat kernels across the plane, which the schema leaves without a meaning.
            if (_cloud.shape != SplatShape::GaussianEllipsoid)
                scale.z = flat * std::max(std::abs(scale.x), std::abs(scale.y));
            const vec3 positive = glm::abs(scale);
            const float largest = std::max({positive.x, positive.y, positive.z});
            if (!isPlain(scale)) continue;
            if (!(largest >= smallest)) {
                hide(i);
                ++without;
                continue;
            }
            mended += std::min({scale.x, scale.y, scale.z}) > 0.0f ? 0 : 1;
            scale = glm::max(positive, vec3(thinnest * largest));
        }
        if (mended) warn("scales", messages::splatScales(mended));
        if (without) warn("scales", messages::splatsWithoutSize(without));
    }
    void dropBroken() {
        size_t broken = 0;
        const auto check = [&](size_t i, bool usable) {
            if (usable) return;
            if (hide(i)) ++broken;
        };
        for (size_t i = 0; i < _count; ++i) {
            bool usable = isPlain(_cloud.positions[i]);
            if (!_cloud.orientations.empty()) {
                const vec4& q = _cloud.orientations[i];
                usable &= !std::isnan(q.x + q.y + q.z + q.w);
            }
            if (!_cloud.scales.empty()) usable &= isPlain(_cloud.scales[i]);
            if (!_cloud.opacities.empty()) usable &= !std::isnan(_cloud.opacities[i]);
            const size_t stride = _cloud.stride();
            for (size_t k = 0; usable && !_cloud.harmonics.empty() && k < stride; ++k)
                usable &= isPlain(_cloud.harmonics[i * stride + k]);
            check(i, usable);
        }
        if (broken) warn("", messages::splatsBroken(broken));
    }
    /// @returns false where it is hidden already
    bool hide(size_t i) {
        if (_cloud.opacities.empty()) _cloud.opacities.assign(_count, 1.0f);
        const bool shown = _cloud.opacities[i] != 0.0f;
        _cloud.opacities[i] = 0.0f;
        return shown;
    }

    SplatCloud& _cloud;
    const size_t _count;
    const std::string& _path;
    Diagnostics& _diagnostics;
};

} // namespace

void setCloud(Splats& prim, SplatCloud cloud, Diagnostics& diagnostics) {
    Checker(cloud, prim.path, diagnostics).run();
    if (!prim.material.empty())
        diagnostics.warn(prim.path, "", messages::splatsMaterial(prim.material));
    prim.cloud = std::make_shared<const SplatCloud>(std::move(cloud));
}

} // namespace patina
