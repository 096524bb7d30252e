// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderDelegate.h"

#include <gtest/gtest.h>
#include <pxr/imaging/hd/basisCurvesTopology.h>
#include <pxr/imaging/hd/changeTracker.h>
#include <pxr/imaging/hd/instancer.h>
#include <pxr/imaging/hd/light.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/rprim.h>
#include <pxr/imaging/hd/sceneDelegate.h>
#include <pxr/imaging/hd/sprim.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace patina {

/// A scene whose answers a test writes down, and which counts what it is asked.
class FakeScene : public HdSceneDelegate {
public:
    using Key = std::pair<SdfPath, TfToken>;
    template <class T> using Samples = std::vector<std::pair<float, T>>; ///< with their times

    explicit FakeScene(HdRenderIndex* index)
        : HdSceneDelegate(index, SdfPath::AbsoluteRootPath()) {}

    std::map<Key, VtValue> lightParams;
    std::map<SdfPath, VtValue> networks;      ///< of materials and lights
    std::map<Key, Samples<VtValue>> primvars; ///< of one sample where nothing moves
    std::map<Key, HdInterpolation> interpolations;
    std::map<SdfPath, Samples<GfMatrix4d>> transforms, instancerTransforms;
    std::set<TfToken> categories; ///< of every rprim
    HdBasisCurvesTopology curves;
    int categoriesAsked = 0;

    void setPrimvar(const SdfPath& id, const TfToken& name, HdInterpolation interpolation,
                    Samples<VtValue> samples) {
        primvars[{id, name}] = std::move(samples);
        interpolations[{id, name}] = interpolation;
    }
    void setPrimvar(const SdfPath& id, const TfToken& name, HdInterpolation interpolation,
                    const VtValue& value) {
        setPrimvar(id, name, interpolation, Samples<VtValue>{{0.0f, value}});
    }

    VtValue Get(const SdfPath& id, const TfToken& name) override {
        const auto found = primvars.find({id, name});
        return found == primvars.end() ? VtValue() : found->second.front().second;
    }
    HdPrimvarDescriptorVector GetPrimvarDescriptors(const SdfPath& id,
                                                    HdInterpolation interpolation) override {
        HdPrimvarDescriptorVector listed;
        for (const auto& item : interpolations)
            if (item.first.first == id && item.second == interpolation)
                listed.emplace_back(item.first.second, interpolation);
        return listed;
    }
    VtValue GetLightParamValue(const SdfPath& id, const TfToken& name) override {
        return valueAt(lightParams, Key(id, name));
    }
    VtValue GetMaterialResource(const SdfPath& id) override { return valueAt(networks, id); }
    VtArray<TfToken> GetCategories(const SdfPath&) override {
        ++categoriesAsked;
        return VtArray<TfToken>(categories.begin(), categories.end());
    }
    HdBasisCurvesTopology GetBasisCurvesTopology(const SdfPath&) override { return curves; }
    GfMatrix4d GetTransform(const SdfPath& id) override { return first(transforms, id); }
    GfMatrix4d GetInstancerTransform(const SdfPath& id) override {
        return first(instancerTransforms, id);
    }

#if PATINA_HAS_SAMPLE_INTERVAL
    size_t SampleTransform(const SdfPath& id, float, float, size_t most, float* times,
                           GfMatrix4d* values) override {
        return sample(transforms, id, most, times, values);
    }
    size_t SampleInstancerTransform(const SdfPath& id, float, float, size_t most, float* times,
                                    GfMatrix4d* values) override {
        return sample(instancerTransforms, id, most, times, values);
    }
    size_t SamplePrimvar(const SdfPath& id, const TfToken& name, float, float, size_t most,
                         float* times, VtValue* values) override {
        return sample(primvars, Key(id, name), most, times, values);
    }
#endif
    // Hydra's emulation of scene indices asks without an interval in all releases.
    size_t SampleTransform(const SdfPath& id, size_t most, float* times,
                           GfMatrix4d* values) override {
        return sample(transforms, id, most, times, values);
    }
    size_t SampleInstancerTransform(const SdfPath& id, size_t most, float* times,
                                    GfMatrix4d* values) override {
        return sample(instancerTransforms, id, most, times, values);
    }
    size_t SamplePrimvar(const SdfPath& id, const TfToken& name, size_t most, float* times,
                         VtValue* values) override {
        return sample(primvars, Key(id, name), most, times, values);
    }

private:
    template <class K> static VtValue valueAt(const std::map<K, VtValue>& all, const K& key) {
        const auto found = all.find(key);
        return found == all.end() ? VtValue() : found->second;
    }
    static GfMatrix4d first(const std::map<SdfPath, Samples<GfMatrix4d>>& all, const SdfPath& id) {
        const auto found = all.find(id);
        return found == all.end() ? GfMatrix4d(1.0) : found->second.front().second;
    }
    template <class K, class T> static size_t
    sample(const std::map<K, Samples<T>>& all, const K& key, size_t most, float* times, T* values) {
        const auto found = all.find(key);
        if (found == all.end()) return 0;
        for (size_t i = 0; i < std::min(most, found->second.size()); ++i) {
            times[i] = found->second[i].first;
            values[i] = found->second[i].second;
        }
        return found->second.size();
    }
};

/// A host that syncs single prims by hand.
class FakeHost : public testing::Test {
protected:
    ~FakeHost() override {
        index.reset(); // its prims may ask the scene
        scene.reset();
    }

    HdPatinaRenderParam& param() {
        return *static_cast<HdPatinaRenderParam*>(delegate->GetRenderParam());
    }
    std::shared_ptr<const SceneState> state() {
        param().commit();
        return param().scene()->snapshot();
    }
    /// @returns how often a prim was warned of with some words
    int warningsOf(const SdfPath& prim, const std::string& words) {
        int count = 0;
        for (const Diagnostic& d : param().scene()->diagnostics().all())
            count += d.prim == prim.GetString() && d.message.find(words) != std::string::npos;
        return count;
    }

    void syncSprim(const TfToken& type, const SdfPath& id) {
        if (!known.count(id)) index->InsertSprim(type, scene.get(), id);
        known.insert(id);
        HdDirtyBits bits = ~HdDirtyBits(HdLight::Clean);
        index->GetSprim(type, id)->Sync(scene.get(), &param(), &bits);
    }
    void syncRprim(const TfToken& type, const SdfPath& id,
                   HdDirtyBits bits = HdChangeTracker::AllSceneDirtyBits) {
        if (!known.count(id)) index->InsertRprim(type, scene.get(), id);
        known.insert(id);
        auto* prim = const_cast<HdRprim*>(index->GetRprim(id));
        prim->Sync(scene.get(), &param(), &bits, HdReprTokens->smoothHull);
    }
    void syncInstancer(const SdfPath& id) {
        if (!known.count(id)) index->InsertInstancer(scene.get(), id);
        known.insert(id);
        HdDirtyBits bits = HdChangeTracker::AllSceneDirtyBits;
        index->GetInstancer(id)->Sync(scene.get(), &param(), &bits);
    }

    std::unique_ptr<HdPatinaRenderDelegate> delegate =
        std::make_unique<HdPatinaRenderDelegate>(HdRenderSettingsMap());
    std::unique_ptr<HdRenderIndex> index{HdRenderIndex::New(delegate.get(), {})};
    std::unique_ptr<FakeScene> scene = std::make_unique<FakeScene>(index.get());
    std::set<SdfPath> known; ///< to the index
};

} // namespace patina
