// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/screenMotion.h"

#include "hdDelegate/scene/lightUnits.h"

namespace patina {

ScreenMotion::ScreenMotion(const Camera& camera, const CameraFrame& frame)
    : _frame(frame), _known(knows(camera)) {
    for (const Moment moment : {Before, Now, After})
        _worldToCamera[moment] = glm::inverse(exactTransformAt(camera.transform, timeCode(moment)));
    const CameraLens& lens = camera.lens;
    if (lens.stereo == StereoView::Left) _eye = -0.5 * double(lens.interocularDistance);
    if (lens.stereo == StereoView::Right) _eye = 0.5 * double(lens.interocularDistance);
    if (lens.convergenceDistance > 0.0f) _towards = 1.0 / double(lens.convergenceDistance);
}

bool ScreenMotion::pixelOf(const dvec3& place, Moment moment, glm::dvec2& pixel) const {
    const dvec3 p(_worldToCamera[moment] * glm::dvec4(place, 1.0));
    if (!_frame.orthographic && !(p.z < 0.0)) return false;
    // As LensRays::ray() has it, the other way round.
    const double away = _frame.orthographic ? 1.0 : -p.z;
    const glm::dvec2 window((p.x - _eye * (1.0 + _towards * p.z)) / away, p.y / away);
    const glm::dvec2 low(_frame.windowMin), high(_frame.windowMax);
    const glm::dvec2 share = (window - low) / (high - low);
    pixel = glm::dvec2(share.x, 1.0 - share.y) * glm::dvec2(_frame.imageSize);
    return true;
}

bool ScreenMotion::way(const dvec3& now, const dvec3& then, Moment moment, float out[2]) const {
    glm::dvec2 from, to;
    if (!_known || !pixelOf(now, Now, from) || !pixelOf(then, moment, to)) return false;
    out[0] = float(to.x - from.x), out[1] = float(to.y - from.y);
    return true;
}

dmat4 ScreenMotion::toWorld(const Geometry& prim, const InstanceStep* steps, int count,
                            Moment moment) {
    dmat4 result(1.0);
    for (int i = 0; i < count; ++i) {
        if (!steps[i].values) continue;
        const Instancer& instancer = steps[i].values->instancer();
        result = result * exactTransformAt(instancer.transforms[size_t(steps[i].instance)],
                                           timeCode(moment));
    }
    return result * exactTransformAt(prim.transform, timeCode(moment));
}

} // namespace patina
