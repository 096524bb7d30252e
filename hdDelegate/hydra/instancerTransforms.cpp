// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/hydra/instancerTransforms.h"

#include "hdDelegate/hydra/sampling.h"
#include "hdDelegate/hydra/values.h"

#include <pxr/base/gf/quatd.h>
#include <pxr/base/gf/quatf.h>
#include <pxr/base/gf/quath.h>
#include <pxr/base/gf/rotation.h>
#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/gf/vec4d.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace patina {

namespace {

using Matrices = std::vector<GfMatrix4d>;

template <class T, class F> bool convert(const VtValue& value, Matrices& out, const F& toMatrix) {
    if (!value.IsHolding<VtArray<T>>()) return false;
    out.clear();
    for (const T& element : value.UncheckedGet<VtArray<T>>())
        out.push_back(toMatrix(element));
    return true;
}

template <class Quaternion> GfMatrix4d rotation(const Quaternion& q) {
    const GfQuatd unit = GfQuatd(q.GetReal(), GfVec3d(q.GetImaginary())).GetNormalized();
    return GfMatrix4d(1.0).SetRotate(unit);
}

template <class Vector> GfMatrix4d rotationOfVector(const Vector& v) {
    return rotation(GfQuatd(v[0], GfVec3d(v[1], v[2], v[3])));
}

/// One of the arrays that make up the transform of an instance.
struct Part {
    std::vector<float> times;
    std::vector<Matrices> values;

    /// The array at a time: the samples around it, interpolated element by element.
    GfMatrix4d at(size_t instance, float time) const {
        if (values.empty()) return GfMatrix4d(1.0);
        const size_t next =
            size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
        const size_t a = next == 0 ? 0 : next - 1, b = std::min(next, values.size() - 1);
        const GfMatrix4d& first = element(a, instance);
        const GfMatrix4d& second = element(b, instance);
        if (a == b || times[b] <= times[a] || time <= times[a]) return first;
        const double f = (time - times[a]) / double(times[b] - times[a]);
        return first * (1.0 - f) + second * f;
    }
    size_t count() const { return values.empty() ? 0 : values[0].size(); }

private:
    const GfMatrix4d& element(size_t sample, size_t instance) const {
        return values[sample][instance];
    }
};

/// Keeps the samples that have as many instances as that of the frame, or the first where all come
/// later. Instances have no names by which those of other counts could be told.
void keepCount(HdPatinaRenderParam& param, const SdfPath& id, const char* input, Part& part) {
    size_t frame = 0;
    for (size_t i = 0; i < part.times.size(); ++i)
        if (part.times[i] <= 0.0f) frame = i;
    const size_t count = part.values.empty() ? 0 : part.values[frame].size();
    Part kept;
    for (size_t i = 0; i < part.times.size(); ++i) {
        if (part.values[i].size() != count) {
            param.warn(id, input, messages::instanceSampleLeftOut(part.values[i].size(), count));
            continue;
        }
        kept.times.push_back(part.times[i]);
        kept.values.push_back(std::move(part.values[i]));
    }
    part = std::move(kept);
}

/// @param input the name that users know
Part read(HdSceneDelegate& delegate, HdPatinaRenderParam& param, const SdfPath& id,
          const TfToken& name, const char* input) {
    ValueSamples samples;
    samplePrimvar(delegate, param, id, name, samples);
    Part part;
    for (size_t i = 0; i < samples.count; ++i) {
        const VtValue& value = samples.values[i];
        Matrices matrices = instanceMatrices(name, value);
        if (matrices.empty()) {
            if (!value.IsEmpty() && !(value.IsArrayValued() && value.GetArraySize() == 0))
                param.warn(id, input, messages::typeNotRead(value.GetTypeName()));
            continue;
        }
        part.times.push_back(samples.times[i]);
        part.values.push_back(std::move(matrices));
    }
    keepCount(param, id, input, part);
    goOn(param, part.times, part.values);
    return part;
}

} // namespace

Matrices instanceMatrices(const TfToken& primvar, const VtValue& value) {
    const auto move = [](const auto& v) { return GfMatrix4d(1.0).SetTranslate(GfVec3d(v)); };
    const auto scale = [](const auto& v) { return GfMatrix4d(1.0).SetScale(GfVec3d(v)); };
    const auto turn = [](const auto& q) { return rotation(q); };
    const auto turnVector = [](const auto& v) { return rotationOfVector(v); };
    Matrices out;
    if (primvar == HdInstancerTokens->instanceTransforms)
        convert<GfMatrix4d>(value, out, [](const GfMatrix4d& m) { return m; });
    else if (primvar == HdInstancerTokens->instanceRotations)
        convert<GfQuath>(value, out, turn) || convert<GfQuatf>(value, out, turn) ||
            convert<GfQuatd>(value, out, turn) || convert<GfVec4f>(value, out, turnVector) ||
            convert<GfVec4d>(value, out, turnVector);
    else if (primvar == HdInstancerTokens->instanceScales)
        convert<GfVec3f>(value, out, scale) || convert<GfVec3d>(value, out, scale);
    else if (primvar == HdInstancerTokens->instanceTranslations)
        convert<GfVec3f>(value, out, move) || convert<GfVec3d>(value, out, move);
    return out;
}

std::vector<MotionTransform> readInstanceTransforms(HdSceneDelegate& delegate, const SdfPath& id,
                                                    HdPatinaRenderParam& param) {
    const Part parts[] = {
        // Gf multiplies row vectors: what is applied first stands first.
        read(delegate, param, id, HdInstancerTokens->instanceTransforms, "transforms"),
        read(delegate, param, id, HdInstancerTokens->instanceScales, "scales"),
        read(delegate, param, id, HdInstancerTokens->instanceRotations, "orientations"),
        read(delegate, param, id, HdInstancerTokens->instanceTranslations, "positions"),
    };
    const char* const inputs[] = {"transforms", "scales", "orientations", "positions"};
    MatrixSamples own;
    sampleInstancerTransform(delegate, param, id, own);
    Part instancer;
    for (size_t i = 0; i < own.count; ++i) {
        instancer.times.push_back(own.times[i]);
        instancer.values.push_back({own.values[i]});
    }
    addNow(param, instancer.times, instancer.values,
           [&] { return Matrices{delegate.GetInstancerTransform(id)}; });
    goOn(param, instancer.times, instancer.values);

    // Instances are as many as their positions, or as what stands in for these.
    size_t count = 0;
    for (const Part& part : parts)
        if (part.count() > 0) count = part.count();
    std::set<float> times;
    for (const Part& part : parts) {
        if (part.count() > 0 && part.count() != count) {
            // As of stages that are read without Hydra.
            param.warn(id, inputs[&part - parts],
                       messages::instanceValuesDiffer(part.count(), count));
            return {};
        }
        if (part.times.size() > 1) times.insert(part.times.begin(), part.times.end());
    }
    if (instancer.times.size() > 1) times.insert(instancer.times.begin(), instancer.times.end());
    if (times.empty()) times.insert(0.0f);

    std::vector<float> kept(times.begin(), times.end());
    if (kept.size() > maxTimeSamples) {
        warnOfSamples(param, id, "transforms", times.size());
        for (size_t i = 0; i < maxTimeSamples; ++i)
            kept[i] = kept[keptSample(i, times.size())];
        kept.resize(maxTimeSamples);
    }

    std::vector<MotionTransform> result;
    result.reserve(count);
    bool broken = false;
    for (size_t i = 0; i < count; ++i) {
        std::vector<dmat4> values;
        for (const float time : kept) {
            GfMatrix4d m(1.0);
            for (const Part& part : parts)
                m *= part.at(i, time);
            m *= instancer.at(0, time);
            values.push_back(toMat4(m));
            for (int c = 0; c < 4; ++c)
                for (int r = 0; r < 4; ++r)
                    if (!std::isfinite(float(values.back()[c][r]))) {
                        broken = true;
                        values.back() = dmat4(0.0); // drawn by none
                    }
        }
        result.push_back(sampledOf(kept, std::move(values)));
    }
    if (broken) param.warn(id, "transforms", messages::someInstancesNotFinite);
    return result;
}

} // namespace patina
