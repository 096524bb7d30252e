// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/cameraCheck.h"

#include "hdDelegate/scene/instancerCheck.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

/// Replaces numbers of one camera.
class Replacer {
public:
    Replacer(Camera& camera, Diagnostics& diagnostics)
        : _camera(camera), _diagnostics(diagnostics) {}

    template <class T>
    void number(const char* input, T& value, T fallback, const Message& what, bool sound) {
        if (sound) return;
        _diagnostics.warn(_camera.path, input, what);
        value = fallback;
        changed = true;
    }
    template <class T> void finite(const char* input, T& value, T fallback) {
        number(input, value, fallback, messages::schemaDefaultUsed, std::isfinite(value));
    }

    void planes() {
        auto& list = _camera.clippingPlanes;
        const auto sound = [](const vec4& p) { return std::isfinite(p.x + p.y + p.z + p.w); };
        if (std::all_of(list.begin(), list.end(), sound)) return;
        _diagnostics.warn(_camera.path, "clippingPlanes", messages::clippingPlanesNotFinite);
        list.erase(
            std::remove_if(list.begin(), list.end(), [&](const vec4& p) { return !sound(p); }),
            list.end());
        changed = true;
    }

    bool changed = false;

private:
    Camera& _camera;
    Diagnostics& _diagnostics;
};

} // namespace

std::shared_ptr<const Camera> checkedCamera(std::shared_ptr<const Camera> camera,
                                            Diagnostics& diagnostics) {
    if (!camera) return camera;
    auto c = std::make_shared<Camera>(*camera);
    const Camera schema;
    Replacer replace(*c, diagnostics);
    replace.finite("horizontalAperture", c->horizontalAperture, schema.horizontalAperture);
    replace.finite("verticalAperture", c->verticalAperture, schema.verticalAperture);
    replace.finite("horizontalApertureOffset", c->horizontalApertureOffset, 0.0f);
    replace.finite("verticalApertureOffset", c->verticalApertureOffset, 0.0f);
    replace.finite("focalLength", c->focalLength, schema.focalLength);
    replace.finite("exposure", c->exposureScale, 1.0f);
    replace.finite("shutter:open", c->shutterOpen, 0.0);
    replace.finite("shutter:close", c->shutterClose, 0.0);
    constexpr float maximum = float(largestPlace);
    const auto within = [](float x) { return std::abs(x) <= maximum; };
    replace.number("clippingRange", c->clipNear, 0.0f, messages::nearNotFinite,
                   within(c->clipNear));
    replace.number("clippingRange", c->clipFar, maximum, messages::farNotFinite,
                   within(c->clipFar));
    if (c->clipFar <= c->clipNear)
        diagnostics.warn(c->path, "clippingRange", messages::clippingRangeEmpty);
    replace.planes();
    replace.number("focusDistance", c->focusDistance,
                   std::isnan(c->focusDistance) ? 0.0f : std::copysign(maximum, c->focusDistance),
                   std::isnan(c->focusDistance) ? messages::focusNoNumber : messages::focusTooFar,
                   within(c->focusDistance));
    const float lens = c->focalLength / c->fStop; // 0 / 0 where there is none
    replace.number("fStop", c->fStop, 0.0f, messages::lensUnusable,
                   c->fStop == 0.0f || (std::isfinite(c->fStop) && within(lens)));
    return replace.changed ? c : camera;
}

} // namespace patina
