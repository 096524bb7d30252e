// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/film/imageFile.h"
#include "hdDelegate/hydra/renderDelegate.h"
#include "hdDelegate/hydra/renderPass.h"
#include "hdDelegate/hydra/renderProducts.h"
#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>
#include <pxr/imaging/hd/renderIndex.h>
#include <pxr/imaging/hd/renderPassState.h>
#include <pxr/imaging/hd/tokens.h>

#include <chrono>
#include <cstdio>
#include <limits>
#include <thread>

using namespace patina;

namespace {

const SdfPath productPath("/Render/product");

void setProduct(HdPatinaDelegateState& state, const HdRenderSettings::RenderProduct& product) {
    HdPatinaSettingsPrim prim;
    prim.active = true;
    prim.products = {product};
    state.setSettingsPrim(SdfPath("/Render/settings"), prim);
}

/// One product of 8 x 4 pixels is to be written.
std::shared_ptr<HdPatinaDelegateState> stateWith(const GfRange2f& window) {
    auto state = std::make_shared<HdPatinaDelegateState>();
    HdPatinaSettings settings;
    settings.interactive = false;
    settings.samples = 1;
    settings.backend = "embree";
    state->setSettings(settings);
    HdRenderSettings::RenderProduct product;
    product.productPath = productPath;
    product.type = TfToken("raster");
    product.name = TfToken(testing::TempDir() + "patinaRenderProduct.exr");
    product.resolution = GfVec2i(8, 4);
    product.cameraPath = SdfPath("/camera");
    product.pixelAspectRatio = 1.0f;
    product.dataWindowNDC = window;
    product.disableMotionBlur = false;
    setProduct(*state, product);
    return state;
}

/// @returns how many warnings of its data window a product gives
int warningsOf(const GfRange2f& window) {
    const auto state = stateWith(window);
    HdPatinaRenderProducts products(*state);
    products.update();
    int count = 0;
    for (const Diagnostic& d : state->param.scene()->diagnostics().all())
        count += d.prim == productPath.GetString() && d.input == "dataWindowNDC" &&
                 d.message == "holds no pixel; the whole image is rendered";
    return count;
}

GfRange2f range(float x0, float y0, float x1, float y1) {
    return GfRange2f(GfVec2f(x0, y0), GfVec2f(x1, y1));
}

} // namespace

TEST(RenderProducts, WindowsWithPixelsAreTaken) {
    constexpr float most = std::numeric_limits<float>::max();
    EXPECT_EQ(warningsOf(GfRange2f()), 0) << "hosts that give none";
    EXPECT_EQ(warningsOf(range(0.0f, 0.0f, 1.0f, 1.0f)), 0);
    EXPECT_EQ(warningsOf(range(0.25f, 0.25f, 0.5f, 0.5f)), 0);
    EXPECT_EQ(warningsOf(range(-0.5f, -0.5f, 1.5f, 1.5f)), 0);
    EXPECT_EQ(warningsOf(range(-most, -1e30f, 1e30f, most)), 0) << "more than integers hold";
}

TEST(RenderProducts, WindowsWithoutPixelsAreToldOf) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(warningsOf(range(0.75f, 0.75f, 0.25f, 0.25f)), 1) << "the wrong way round";
    EXPECT_EQ(warningsOf(range(0.5f, 0.0f, 0.51f, 1.0f)), 1) << "between two pixels";
    EXPECT_EQ(warningsOf(range(2.0f, 0.0f, 3.0f, 1.0f)), 0) << "beside the frame";
    EXPECT_EQ(warningsOf(range(1e30f, 0.0f, 2e30f, 1.0f)), 1);
    EXPECT_EQ(warningsOf(range(-2e30f, 0.0f, -1e30f, 1.0f)), 1);
    EXPECT_EQ(warningsOf(range(nan, 0.0f, 1.0f, 1.0f)), 1);
    EXPECT_EQ(warningsOf(range(0.0f, 0.0f, 1.0f, nan)), 1);
    EXPECT_EQ(warningsOf(range(0.0f, 0.0f, infinity, 1.0f)), 1);
}

TEST(RenderProducts, OfTypeDeepRasterAreDeepImages) {
    const auto state = stateWith(GfRange2f());
    state->param.set<Camera>(makePrim<Camera>("/camera"));
    state->param.set<Geometry>(makePrim<Implicit>("/ball", translate(0, 0, -20)));
    HdRenderSettings::RenderProduct product = state->products().front();
    const std::string file = testing::TempDir() + "patinaDeepProduct.exr";
    product.type = TfToken("deepRaster");
    product.name = TfToken(file);
    setProduct(*state, product);
    HdPatinaRenderProducts products(*state);
    while (!products.update())
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    const DeepImage image = readDeep(file);
    EXPECT_EQ(image.width, 8);
    EXPECT_GT(image.values.size(), 0u);
    std::remove(file.c_str());
}

TEST(RenderProducts, NoneIsStartedAfterAStop) {
    HdPatinaRenderDelegate delegate{HdRenderSettingsMap()};
    const std::unique_ptr<HdRenderIndex> index(HdRenderIndex::New(&delegate, {}));
    const auto state = stateWith(GfRange2f());
    HdPatinaRenderPass pass(index.get(), HdRprimCollection(), state);
    const HdRenderPassStateSharedPtr passState = delegate.CreateRenderPassState();
    // Only the pass has a session. The products make one for the first of them that starts.
    state->stop();
    pass.Execute(passState, {HdRenderTagTokens->geometry});
    EXPECT_EQ(state->sessions().size(), 1u);
    EXPECT_TRUE(pass.IsConverged()) << "or hosts wait for ever";
    state->restart();
    state->pause(true);
    pass.Execute(passState, {HdRenderTagTokens->geometry});
    EXPECT_EQ(state->sessions().size(), 1u);
    EXPECT_FALSE(pass.IsConverged());
    state->pause(false);
    pass.Execute(passState, {HdRenderTagTokens->geometry});
    EXPECT_EQ(state->sessions().size(), 2u);
}
