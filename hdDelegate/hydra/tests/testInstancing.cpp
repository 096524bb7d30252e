// SPDX-License-Identifier: Apache-2.0
// Arrays of instancers: of many samples, of lengths that do not fit, of types that nothing reads.

#include "hdDelegate/hydra/instancerTransforms.h"
#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/sampling.h"
#include "hdDelegate/hydra/tests/fakeScene.h"

#include <pxr/base/gf/multiInterval.h>
#include <pxr/base/gf/quatf.h>
#include <pxr/base/gf/vec2f.h>
#include <pxr/base/gf/vec3f.h>

using namespace patina;

namespace {

const SdfPath path("/instancer");

class Instancing : public FakeHost {
protected:
    template <class T> void set(const TfToken& name, const T& value) {
        scene->setPrimvar(path, name, HdInterpolationInstance, VtValue(value));
    }
    void setSamples(const TfToken& name, FakeScene::Samples<VtValue> samples) {
        scene->setPrimvar(path, name, HdInterpolationInstance, std::move(samples));
    }
    void setPositions(size_t count) {
        set(HdInstancerTokens->instanceTranslations,
            VtVec3fArray(count, GfVec3f(1.0f, 2.0f, 3.0f)));
    }
    std::vector<MotionTransform> read() { return readInstanceTransforms(*scene, path, param()); }
};

} // namespace

TEST_F(Instancing, TakesSomeOfThousandsOfSamples) {
    constexpr int count = 5000;
    FakeScene::Samples<VtValue> positions;
    for (int i = 0; i < count; ++i) {
        const float time = float(i) / float(count - 1) - 0.5f;
        GfMatrix4d matrix(1.0);
        scene->instancerTransforms[path].emplace_back(time, matrix.SetTranslate(GfVec3d(time)));
        // Other times than those of the transform, so that all together are twice as many.
        positions.emplace_back(0.9f * time, VtValue(VtVec3fArray(100, GfVec3f(time))));
    }
    setSamples(HdInstancerTokens->instanceTranslations, positions);
    ASSERT_TRUE(param().widenShutter(-0.5, 0.5));
    const std::vector<MotionTransform> transforms = read();
    ASSERT_EQ(transforms.size(), 100u);
    for (const MotionTransform& transform : transforms) {
        ASSERT_LE(transform.times.size(), size_t(maxTimeSamples));
        EXPECT_EQ(transform.times.front(), -0.5f);
        EXPECT_EQ(transform.times.back(), 0.5f);
        EXPECT_EQ(transform.values.front()[3].x, -1.0); // both at their start
        EXPECT_EQ(transform.values.back()[3].x, 1.0);
    }
    EXPECT_EQ(warningsOf(path, "has 5000 time samples in the shutter; 32 of them are used"), 2);

    scene->transforms[path] = scene->instancerTransforms[path];
    MatrixSamples samples;
    sampleTransform(*scene, param(), path, samples);
    ASSERT_EQ(samples.count, size_t(maxTimeSamples));
    EXPECT_EQ(samples.times[0], -0.5f);
    EXPECT_EQ(samples.times[maxTimeSamples - 1], 0.5f);
    for (size_t i = 1; i < samples.count; ++i)
        EXPECT_NEAR(samples.times[i] - samples.times[i - 1], 1.0f / 31.0f, 1e-3f);
}

TEST_F(Instancing, KeepsSamplesAsTheyAreUpToTheLimit) {
    for (unsigned i = 0; i < maxTimeSamples; ++i)
        scene->transforms[path].emplace_back(float(i) / 64.0f, GfMatrix4d(double(i + 1)));
    ASSERT_TRUE(param().widenShutter(0.0, 0.5));
    MatrixSamples samples;
    sampleTransform(*scene, param(), path, samples);
    ASSERT_EQ(samples.count, size_t(maxTimeSamples));
    EXPECT_EQ(samples.times[5], 5.0f / 64.0f);
    EXPECT_EQ(param().scene()->diagnostics().count(), 0);
}

TEST_F(Instancing, DrawsNothingWhereArraysDifferInLength) {
    setPositions(3);
    EXPECT_EQ(read().size(), 3u);
    set(HdInstancerTokens->instanceRotations, VtQuatfArray(2, GfQuatf(1.0f)));
    EXPECT_TRUE(read().empty());
    EXPECT_EQ(warningsOf(path, "has 2 values for 3 instances; nothing is drawn of the instancer"),
              1);
    set(HdInstancerTokens->instanceRotations, VtQuatfArray());
    EXPECT_EQ(read().size(), 3u) << "none is authored";
}

TEST_F(Instancing, LeavesOutSamplesOfOtherLengths) {
    setSamples(HdInstancerTokens->instanceTranslations,
               {{-0.5f, VtValue(VtVec3fArray(3, GfVec3f(1.0f)))},
                {0.5f, VtValue(VtVec3fArray(5, GfVec3f(2.0f)))}});
    ASSERT_TRUE(param().widenShutter(-0.5, 0.5));
    const std::vector<MotionTransform> transforms = read();
    ASSERT_EQ(transforms.size(), 3u);
    EXPECT_FALSE(transforms[2].moves());
    EXPECT_EQ(transforms[2].first()[3].x, 1.0);
    EXPECT_EQ(warningsOf(path, "has 5 values for 3 instances; that sample is left out"), 1);
}

TEST_F(Instancing, SaysWhichTypeIsNotRead) {
    setPositions(3);
    set(HdInstancerTokens->instanceScales, VtVec2fArray(3, GfVec2f(2.0f)));
    const std::vector<MotionTransform> transforms = read();
    ASSERT_EQ(transforms.size(), 3u);
    EXPECT_EQ(transforms[0].first()[0].x, 1.0) << "no scale";
    EXPECT_EQ(warningsOf(path, ", which is not read here"), 1);
    for (const Diagnostic& d : param().scene()->diagnostics().all())
        EXPECT_EQ(d.input, "scales");
}

TEST_F(Instancing, LeavesOutPrimvarsOfOtherLengths) {
    setPositions(3);
    set(TfToken("good"), VtFloatArray(3, 0.5f));
    set(TfToken("short"), VtVec3fArray(2, GfVec3f(0.5f)));
    set(TfToken("label"), VtStringArray(3, "text"));
    set(TfToken("odd"), GfMultiInterval());
    syncInstancer(path);
    param().instances().place(SdfPath("/prototype"), path, {0, 1, 2});
    const auto scene = state();
    const auto found = scene->instancers.find(path.GetString());
    ASSERT_NE(found, scene->instancers.end());
    ASSERT_EQ(found->second->primvars.size(), 1u);
    EXPECT_EQ(found->second->primvars[0].name, "good");
    EXPECT_EQ(warningsOf(path, "has 2 values for 3 instances; it is left out"), 1);
    EXPECT_EQ(warningsOf(path, "which holds no numbers; it is left out"), 1);
    EXPECT_EQ(param().scene()->diagnostics().count(), 2);
}
