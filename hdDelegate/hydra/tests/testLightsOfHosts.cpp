// SPDX-License-Identifier: Apache-2.0
// What lights refer to, and what refers to them.

#include "hdDelegate/hydra/instances.h"
#include "hdDelegate/hydra/readAgain.h"
#include "hdDelegate/hydra/tests/fakeScene.h"
#include "hdDelegate/scene/sceneDump.h"

#include <pxr/base/gf/vec3f.h>
#include <pxr/imaging/hd/material.h>
#include <pxr/usd/sdf/assetPath.h>

using namespace patina;

namespace {

const TfToken sphereLight("sphereLight"), lightFilter("lightFilter");

class LightsOfHosts : public FakeHost {
protected:
    void setFilters(const SdfPath& light, const SdfPathVector& filters) {
        scene->lightParams[{light, HdTokens->filters}] = VtValue(filters);
    }
    void setShader(const SdfPath& prim, const char* shader) {
        scene->lightParams[{prim, TfToken("lightFilter:shaderId")}] = VtValue(TfToken(shader));
    }
    std::shared_ptr<const Light> lightAt(const SdfPath& light) {
        return state()->lights.at(light.GetString());
    }
    std::vector<LightFilter> filtersOf(const SdfPath& light) { return lightAt(light)->filters; }
};

} // namespace

TEST_F(LightsOfHosts, AFilterIsRead) {
    const SdfPath light("/light"), rod("/rod");
    setShader(rod, "PxrRodLightFilter");
    setFilters(light, {rod});
    syncSprim(lightFilter, rod);
    syncSprim(sphereLight, light);
    ASSERT_EQ(filtersOf(light).size(), 1u);
    EXPECT_EQ(filtersOf(light)[0].type, LightFilterType::Rod);
}

TEST_F(LightsOfHosts, ALightIsNoFilterOfItself) {
    const SdfPath light("/light");
    setShader(light, "PxrRodLightFilter");
    setFilters(light, {light});
    syncSprim(sphereLight, light);
    EXPECT_TRUE(filtersOf(light).empty());
    EXPECT_EQ(warningsOf(light, "/light is no light filter; it is left out"), 1);
    index->GetChangeTracker().MarkSprimDirty(light, HdLight::DirtyParams); // comes to an end
}

TEST_F(LightsOfHosts, LightsAreNoFiltersOfEachOther) {
    const SdfPath a("/a"), b("/b");
    for (const SdfPath& light : {a, b}) {
        setShader(light, "PxrRodLightFilter");
        setFilters(light, {light == a ? b : a});
    }
    syncSprim(sphereLight, a);
    syncSprim(sphereLight, b);
    syncSprim(sphereLight, a);
    EXPECT_TRUE(filtersOf(a).empty() && filtersOf(b).empty());
    EXPECT_EQ(warningsOf(a, "/b is no light filter"), 1);
    EXPECT_EQ(warningsOf(b, "/a is no light filter"), 1);
    index->GetChangeTracker().MarkSprimDirty(a, HdLight::DirtyParams);
    index->GetChangeTracker().MarkSprimDirty(b, HdLight::DirtyParams);
}

TEST_F(LightsOfHosts, NamesOfFiltersInputsMayBeAnyNumber) {
    const SdfPath light("/light"), barn("/barn");
    setShader(barn, "PxrBarnLightFilter");
    setFilters(light, {barn});
    const TfToken mode("inputs:ri:lightFilter:barnMode");
    scene->lightParams[{barn, mode}] = VtValue(1);
    syncSprim(lightFilter, barn);
    syncSprim(sphereLight, light);
    ASSERT_EQ(filtersOf(light).size(), 1u);
    EXPECT_EQ(filtersOf(light)[0].mode, "1");
    scene->lightParams[{barn, mode}] = VtValue(1e300);
    syncSprim(sphereLight, light);
    EXPECT_EQ(filtersOf(light)[0].mode, LightFilter().mode);
    EXPECT_EQ(warningsOf(light, "that is not a number of the schema"), 1);
}

TEST_F(LightsOfHosts, ATextureHasTheColourSpaceThatTheLightsNodeTells) {
    const SdfPath light("/light");
    HdMaterialNode node;
    node.path = light;
    node.identifier = TfToken("DomeLight");
    node.parameters[TfToken("colorSpace:texture:file")] = VtValue(TfToken("raw"));
    HdMaterialNetworkMap map;
    map.map[HdMaterialTerminalTokens->light].nodes = {node};
    map.terminals = {light};
    scene->networks[light] = VtValue(map);
    scene->lightParams[{light, TfToken("texture:file")}] = VtValue(SdfAssetPath("sky.png"));
    syncSprim(HdPrimTypeTokens->domeLight, light);
    EXPECT_EQ(lightAt(light)->textureColorSpace, "raw");
}

/// Of n lights and m prims m are asked, not n times m.
TEST_F(LightsOfHosts, LinksOfManyLightsAreReadOnce) {
    constexpr int count = 100;
    for (int i = 0; i < count; ++i)
        syncRprim(HdPrimTypeTokens->mesh, SdfPath("/mesh" + std::to_string(i)));
    state();
    scene->categories = {TfToken("/link")};
    scene->categoriesAsked = 0;
    for (int i = 0; i < count; ++i) {
        const SdfPath light("/light" + std::to_string(i));
        scene->lightParams[{light, HdTokens->lightLink}] = VtValue(TfToken("/link"));
        syncSprim(sphereLight, light);
    }
    EXPECT_EQ(scene->categoriesAsked, 0) << "while the lights sync";
    readAgain(*index, param());
    EXPECT_LE(scene->categoriesAsked, 4 * count);
    const std::vector<std::string> linked = {"/link"};
    for (const auto& prim : state()->geometry)
        EXPECT_EQ(prim.second->categories, linked) << prim.first;
    scene->categoriesAsked = 0;
    readAgain(*index, param());
    EXPECT_EQ(scene->categoriesAsked, 0) << "nothing has changed since";
}

TEST_F(LightsOfHosts, AShutterThatOpensLaterBlursAllThatMoves) {
    const SdfPath light("/light"), instancer("/instancer");
    const auto at = [](double x) { return GfMatrix4d(1.0).SetTranslate(GfVec3d(x, 0.0, 0.0)); };
    scene->transforms[light] = {{-0.25f, at(1.0)}, {0.25f, at(3.0)}};
    scene->instancerTransforms[instancer] = {{-0.25f, at(2.0)}, {0.25f, at(5.0)}};
    scene->setPrimvar(instancer, HdInstancerTokens->instanceTranslations, HdInterpolationInstance,
                      {{-0.25f, VtValue(VtVec3fArray{GfVec3f(0.0f), GfVec3f(1.0f)})},
                       {0.25f, VtValue(VtVec3fArray{GfVec3f(4.0f), GfVec3f(7.0f)})}});
    const auto sync = [&] {
        syncSprim(sphereLight, light);
        syncInstancer(instancer);
        param().instances().place(SdfPath("/prototype"), instancer, {0, 1});
    };
    sync();
    EXPECT_FALSE(lightAt(light)->transform.moves());
    ASSERT_TRUE(param().widenShutter(-0.25, 0.25)); // as a camera does
    readAgain(*index, param());
    const std::string later = dumpScene(*state());
    EXPECT_TRUE(lightAt(light)->transform.moves());
    EXPECT_TRUE(state()->instancers.find("/instancer")->second->transforms[1].moves());
    sync(); // as at first, with the shutter open
    EXPECT_EQ(later, dumpScene(*state()));
    EXPECT_FALSE(param().takeShutterWidened());
}

TEST_F(LightsOfHosts, AnotherRenderingSpaceReadsAllColoursAgain) {
    const SdfPath light("/light");
    const vec3 given(0.7f, 0.2f, 0.1f);
    scene->lightParams[{light, HdLightTokens->color}] = VtValue(GfVec3f(0.7f, 0.2f, 0.1f));
    syncSprim(sphereLight, light);
    EXPECT_EQ(lightAt(light)->color, given);
    const RenderingSpace& aces = *RenderingSpace::find("acescg");
    param().setRenderingSpace(aces);
    readAgain(*index, param());
    EXPECT_EQ(state()->renderingSpace, &aces);
    EXPECT_EQ(lightAt(light)->color, aces.from709(given));
    EXPECT_FALSE(param().takeRenderingSpaceChanged());
    param().setRenderingSpace(RenderingSpace::rec709());
    readAgain(*index, param());
    EXPECT_EQ(lightAt(light)->color, given);
}
