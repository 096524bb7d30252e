// SPDX-License-Identifier: Apache-2.0
// Stages that refer in circles, name prims as the plugin does, or begin to move while they are
// shown.

#include "hdDelegate/hydra/tests/warnings.h"
#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/tests/comparing.h"

#include <pxr/base/gf/vec3d.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/base/vt/array.h>
#include <pxr/usd/sdf/types.h>
#include <pxr/usd/usd/attribute.h>
#include <pxr/usd/usd/prim.h>
#include <pxr/usd/usd/relationship.h>

#include <string>

using namespace patina;

namespace {

class HydraStages : public testing::TestWithParam<bool> {
protected:
    static HostOptions options(bool sceneIndex) {
        HostOptions options;
        options.sceneIndex = sceneIndex;
        options.width = options.height = 16;
        options.camera = SdfPath("/World/cameras/main");
        options.time = UsdTimeCode(1.0);
        options.settings[TfToken("samples")] = VtValue(2);
        return options;
    }
};

UsdPrim at(const UsdStageRefPtr& stage, const char* path) {
    return stage->GetPrimAtPath(SdfPath(path));
}

template <class T> void set(const UsdPrim& prim, const char* name, const T& value, double time) {
    ASSERT_TRUE(prim.GetAttribute(TfToken(name)).Set(value, UsdTimeCode(time))) << name;
}

void setShader(const UsdPrim& prim, const char* shader) {
    prim.CreateAttribute(TfToken("lightFilter:shaderId"), SdfValueTypeNames->Token, false,
                         SdfVariabilityUniform)
        .Set(TfToken(shader));
}

} // namespace

TEST_P(HydraStages, AShutterThatOpensLaterBlursLightsAndInstances) {
    const UsdStageRefPtr stage = makeBaseStage();
    at(stage, "/World/native").SetActive(false); // UsdImagingDelegate names these by their order
    const UsdPrim bulb = at(stage, "/World/lights/bulb"), many = at(stage, "/World/instancer");
    set(bulb, "xformOp:translate", GfVec3d(-3.0, 2.0, 2.0), 0.0);
    set(bulb, "xformOp:translate", GfVec3d(-2.0, 2.5, 2.0), 2.0);
    const VtArray<GfVec3f> first = {GfVec3f(-2, 0, 2), GfVec3f(-1, 0, 2), GfVec3f(0, 0, 2)};
    const VtArray<GfVec3f> last = {GfVec3f(-2, 1, 2), GfVec3f(-1, 1, 2), GfVec3f(0, 1, 2)};
    set(many, "positions", first, 0.0);
    set(many, "positions", last, 2.0);

    Host edited(stage, options(GetParam()));
    ASSERT_TRUE(edited.render(120.0));
    const std::string still = sceneText(edited);
    const UsdPrim camera = at(stage, "/World/cameras/main");
    ASSERT_TRUE(camera.GetAttribute(TfToken("shutter:open")).Set(-0.25));
    ASSERT_TRUE(camera.GetAttribute(TfToken("shutter:close")).Set(0.25));
    ASSERT_TRUE(edited.render(120.0));
    Host fresh(stage, options(GetParam()));
    ASSERT_TRUE(fresh.render(120.0));
    EXPECT_EQ(differences(sceneText(edited), sceneText(fresh)), "");
    EXPECT_NE(differences(still, sceneText(fresh)), "");
    EXPECT_EQ(differentPixels(edited.read("color"), fresh.read("color")), 0);
}

TEST_P(HydraStages, ALightMayNameItselfAsItsFilter) {
    const UsdStageRefPtr stage = makeBaseStage();
    const UsdPrim key = at(stage, "/World/lights/key"), bulb = at(stage, "/World/lights/bulb");
    const UsdPrim rod = stage->DefinePrim(SdfPath("/World/lights/rod"), TfToken("LightFilter"));
    for (const UsdPrim& prim : {key, bulb, rod})
        setShader(prim, "PxrRodLightFilter");
    key.CreateRelationship(TfToken("light:filters"))
        .SetTargets({key.GetPath(), bulb.GetPath(), rod.GetPath()});
    bulb.CreateRelationship(TfToken("light:filters")).SetTargets({key.GetPath()});

    const Warnings warnings;
    Host host(stage, options(GetParam()));
    ASSERT_TRUE(host.render(120.0));
    const std::string text = sceneText(host);
    EXPECT_NE(text.find("filter = /World/lights/rod"), std::string::npos);
    EXPECT_EQ(text.find("filter = /World/lights/key"), std::string::npos);
    EXPECT_EQ(text.find("filter = /World/lights/bulb"), std::string::npos);
    EXPECT_GE(warnings.of("/World/lights/key is no light filter; it is left out"), 1);
    for (const UsdPrim& prim : {key, bulb}) // edits come to an end
        ASSERT_TRUE(prim.GetAttribute(TfToken("inputs:intensity")).Set(3.0f));
    EXPECT_TRUE(host.render(120.0));
}

TEST_P(HydraStages, AChildOfAMeshLightMayHaveTheNameOfTheLight) {
    if (!GetParam()) GTEST_SKIP() << "UsdImagingDelegate has no lights of meshes";
    const UsdStageRefPtr stage = makeBaseStage();
    const UsdPrim mesh = at(stage, "/World/geometry/polygons");
    mesh.AddAppliedSchema(TfToken("MeshLightAPI"));
    const Warnings warnings;
    const std::string words = "/light_of_mesh is hidden by the light of its mesh";
    Host host(stage, options(true));
    ASSERT_TRUE(host.render(120.0));
    EXPECT_EQ(warnings.of(words), 0);
    stage->DefinePrim(mesh.GetPath().AppendChild(TfToken("light_of_mesh")), TfToken("Sphere"));
    ASSERT_TRUE(host.render(120.0));
    EXPECT_EQ(warnings.of(words), 1);
    Host fresh(stage, options(true));
    ASSERT_TRUE(fresh.render(120.0));
    EXPECT_EQ(warnings.of(words), 2) << "each host says it once";
}

INSTANTIATE_TEST_SUITE_P(Inputs, HydraStages, testing::Bool(), inputName);
