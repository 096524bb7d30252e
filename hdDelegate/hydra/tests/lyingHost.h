// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/hydra/renderBuffer.h"
#include "hdDelegate/hydra/renderDelegate.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>
#include <pxr/base/gf/vec3i.h>
#include <pxr/base/gf/vec4f.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/renderPass.h>
#include <pxr/imaging/hd/renderPassState.h>
#include <pxr/imaging/hd/tokens.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace patina {

inline constexpr int endless = 1 << 30; ///< more samples than any test waits for
inline const GfVec4f clearColor(0.25f, 0.5f, 0.75f, 1.0f);

inline std::shared_ptr<Light> skyOf(float intensity) {
    auto sky = makeLight("/sky", LightType::Dome);
    sky->intensity = intensity;
    return sky;
}

/// A host of a white sky that does as it likes.
class LyingHost : public testing::Test {
protected:
    LyingHost() { open(endless); }
    ~LyingHost() override {
        for (HdRenderBuffer* buffer : buffers)
            if (buffer) drop(buffer);
        pass.reset();
        index.reset();
    }

    void open(int samples) {
        pass.reset();
        index.reset();
        delegate = std::make_unique<HdPatinaRenderDelegate>(HdRenderSettingsMap());
        delegate->SetRenderSetting(TfToken("samples"), VtValue(samples));
        delegate->SetRenderSetting(TfToken("backend"), VtValue(std::string("embree")));
        index.reset(HdRenderIndex::New(delegate.get(), {}));
        setSky(1.0f);
        const HdRprimCollection all(HdTokens->geometry, HdReprSelector(HdReprTokens->smoothHull));
        pass = delegate->CreateRenderPass(index.get(), all);
        state = delegate->CreateRenderPassState();
        frame(16, 12);
    }

    HdPatinaRenderParam& param() {
        return *static_cast<HdPatinaRenderParam*>(delegate->GetRenderParam());
    }

    void setSky(float intensity) {
        param().set<Light>(skyOf(intensity));
        param().commit();
    }

    void frame(int width, int height) {
        state->SetFraming(CameraUtilFraming(GfRect2i(GfVec2i(0), width, height)));
    }

    HdRenderBuffer* add(int width = 16, int height = 12, HdFormat format = HdFormatFloat32Vec4,
                        bool multiSampled = false) {
        const SdfPath path("/buffer" + std::to_string(buffers.size()));
        auto* buffer = static_cast<HdRenderBuffer*>(
            delegate->CreateBprim(HdPrimTypeTokens->renderBuffer, path));
        if (width >= 0) buffer->Allocate(GfVec3i(width, height, 1), format, multiSampled);
        buffers.push_back(buffer);
        return buffer;
    }

    /// Hosts destroy buffers by way of the render index, which calls this.
    void drop(HdRenderBuffer* buffer) {
        buffer->Finalize(&param());
        std::replace(buffers.begin(), buffers.end(), buffer, static_cast<HdRenderBuffer*>(nullptr));
        delegate->DestroyBprim(buffer);
    }

    static HdRenderPassAovBinding binding(const char* aov, HdRenderBuffer* buffer) {
        HdRenderPassAovBinding binding;
        binding.aovName = TfToken(aov);
        binding.renderBuffer = buffer;
        if (binding.aovName == "color") binding.clearValue = VtValue(clearColor);
        return binding;
    }

    void bind(const HdRenderPassAovBindingVector& bindings) { state->SetAovBindings(bindings); }
    /// Adds a buffer and binds it alone, as the colour.
    HdRenderBuffer* bindColor() {
        HdRenderBuffer* color = add();
        bind({binding("color", color)});
        return color;
    }
    void execute() { pass->Execute(state, {HdRenderTagTokens->geometry}); }

    /// Executes until something holds. @returns false after a minute
    template <class Holds> bool executesUntil(const Holds& holds) {
        for (int i = 0; i < 60000; ++i) {
            execute();
            if (holds()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return false;
    }
    bool converges() {
        return executesUntil([&] { return pass->IsConverged(); });
    }
    bool waitForSky(HdRenderBuffer* buffer) {
        return executesUntil([&] { return showsSky(buffer); });
    }

    static std::vector<float> pixels(HdRenderBuffer* buffer) {
        const size_t count = size_t(buffer->GetWidth()) * buffer->GetHeight() *
                             HdGetComponentCount(buffer->GetFormat());
        const auto* data = static_cast<const float*>(buffer->Map());
        std::vector<float> copy(data, data + (data ? count : 0));
        buffer->Unmap();
        return copy;
    }

    static bool showsSky(HdRenderBuffer* buffer) {
        const std::vector<float> found = pixels(buffer);
        return !found.empty() && std::all_of(found.begin(), found.end(),
                                             [](float x) { return std::abs(x - 1.0f) < 1e-3f; });
    }

    /// Every pixel is the colour that buffers are cleared with.
    static void expectClear(HdRenderBuffer* buffer, const std::string& why) {
        const std::vector<float> found = pixels(buffer);
        for (size_t i = 0; i < found.size(); ++i)
            ASSERT_EQ(found[i], clearColor[i % 4]) << why;
    }

    std::unique_ptr<HdPatinaRenderDelegate> delegate;
    std::unique_ptr<HdRenderIndex> index;
    HdRenderPassSharedPtr pass;
    HdRenderPassStateSharedPtr state;
    std::vector<HdRenderBuffer*> buffers;
};

} // namespace patina
