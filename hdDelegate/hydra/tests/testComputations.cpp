// SPDX-License-Identifier: Apache-2.0
// Primvars that hosts have computed, as points of skinned meshes are.

#include "hdDelegate/hydra/tests/fakeScene.h"

#include <pxr/base/gf/vec3f.h>
#include <pxr/imaging/hd/extComputation.h>
#include <pxr/imaging/hd/extComputationContext.h>

using namespace patina;

namespace {

const SdfPath prim("/prim"), computation("/prim/computation");
const TfToken rest("rest"), move("move"), moved("moved");

/// Points that stand at rest and are moved. As scene indices of some releases do, it counts no
/// sample of an input that does not vary.
class ComputingScene : public FakeScene {
public:
    using FakeScene::FakeScene;

    std::map<TfToken, Samples<VtValue>> inputs;
    int failures = 0;

    HdExtComputationPrimvarDescriptorVector
    GetExtComputationPrimvarDescriptors(const SdfPath& id, HdInterpolation interpolation) override {
        if (id != prim || interpolation != HdInterpolationVertex) return {};
        return {HdExtComputationPrimvarDescriptor(HdTokens->points, interpolation,
                                                  HdPrimvarRoleTokens->point, computation, moved,
                                                  HdTupleType{HdTypeFloatVec3, 1})};
    }
    TfTokenVector GetExtComputationSceneInputNames(const SdfPath&) override { return {rest, move}; }
    HdExtComputationOutputDescriptorVector
    GetExtComputationOutputDescriptors(const SdfPath&) override {
        return {HdExtComputationOutputDescriptor(moved, HdTupleType{HdTypeFloatVec3, 1})};
    }
    VtValue GetExtComputationInput(const SdfPath&, const TfToken& name) override {
        const auto found = inputs.find(name);
        return found == inputs.end() ? VtValue() : found->second.front().second;
    }
    void InvokeExtComputation(const SdfPath&, HdExtComputationContext* context) override {
        const VtValue& a = context->GetInputValue(rest);
        const VtValue& b = context->GetInputValue(move);
        if (a.IsHolding<GfVec3f>() && b.IsHolding<GfVec3f>()) {
            const GfVec3f sum = a.UncheckedGet<GfVec3f>() + b.UncheckedGet<GfVec3f>();
            context->SetOutputValue(moved, VtValue(VtVec3fArray{sum}));
        } else {
            ++failures;
            context->RaiseComputationError();
        }
    }
#if PATINA_HAS_COMPUTED_INTERVAL
    size_t SampleExtComputationInput(const SdfPath&, const TfToken& name, float, float, size_t,
                                     float* times, VtValue* values) override {
        return give(name, times, values);
    }
#endif
    size_t SampleExtComputationInput(const SdfPath&, const TfToken& name, size_t, float* times,
                                     VtValue* values) override {
        return give(name, times, values);
    }

private:
    size_t give(const TfToken& name, float* times, VtValue* values) {
        const Samples<VtValue>& samples = inputs[name];
        for (size_t i = 0; i < samples.size(); ++i) {
            times[i] = samples[i].first;
            values[i] = samples[i].second;
        }
        return samples.size() > 1 ? samples.size() : 0;
    }
};

class Computations : public FakeHost {
protected:
    Computations() {
        auto computing = std::make_unique<ComputingScene>(index.get());
        host = computing.get();
        scene = std::move(computing);
        host->inputs[rest] = {{0.0f, VtValue(GfVec3f(0.0f, 2.0f, 0.0f))}};
        host->inputs[move] = {{-0.25f, VtValue(GfVec3f(1.0f, 0.0f, 0.0f))}};
    }
    Sampled<std::vector<vec3>> points() {
        syncSprim(HdPrimTypeTokens->extComputation, computation);
        syncRprim(HdPrimTypeTokens->points, prim);
        const auto drawn = state();
        const auto found = drawn->geometry.find(prim.GetString());
        if (found == drawn->geometry.end()) return {};
        return std::dynamic_pointer_cast<const Points>(found->second)->points;
    }

    ComputingScene* host;
};

} // namespace

TEST_F(Computations, InputsThatDoNotVaryGiveOneSample) {
    for (const bool open : {false, true}) {
        if (open) {
            ASSERT_TRUE(param().widenShutter(-0.25, 0.25));
        }
        const auto found = points();
        ASSERT_EQ(found.values.size(), 1u) << "shutter open: " << open;
        EXPECT_EQ(found.first(), std::vector<vec3>{vec3(1.0f, 2.0f, 0.0f)});
    }
    EXPECT_EQ(host->failures, 0);
}

TEST_F(Computations, InputsThatDoNotVaryServeThoseThatDo) {
    host->inputs[move].emplace_back(0.25f, VtValue(GfVec3f(3.0f, 0.0f, 0.0f)));
    ASSERT_TRUE(param().widenShutter(-0.25, 0.25));
    const auto found = points();
    // Without the interval the time of the other input counts as well.
    ASSERT_EQ(found.times,
              (PATINA_HAS_COMPUTED_INTERVAL ? std::vector<float>{-0.25f, 0.25f}
                                            : std::vector<float>{-0.25f, 0.0f, 0.25f}));
    ASSERT_EQ(found.values.size(), found.times.size());
    for (size_t i = 0; i < found.times.size(); ++i)
        EXPECT_EQ(found.values[i],
                  std::vector<vec3>{vec3(2.0f + 4.0f * found.times[i], 2.0f, 0.0f)});
    EXPECT_EQ(host->failures, 0);
}

TEST_F(Computations, WhatFailsIsToldAndShownAsAuthored) {
    host->inputs.erase(move);
    host->setPrimvar(prim, HdTokens->points, HdInterpolationVertex,
                     VtValue(VtVec3fArray{GfVec3f(5.0f)}));
    const auto found = points();
    ASSERT_EQ(found.values.size(), 1u);
    EXPECT_EQ(found.first(), std::vector<vec3>{vec3(5.0f)});
    EXPECT_EQ(warningsOf(prim, "cannot be computed by the host; what is authored is shown"), 1);
}
