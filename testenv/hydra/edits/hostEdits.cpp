// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/edits.h"

#include <pxr/usd/usdGeom/camera.h>

namespace patina {

namespace {

void switchCamera(const UsdStageRefPtr&, Host& host, Random& random) {
    host.setCamera(SdfPath(random.chance(0.5f) ? "/World/cameras/main" : "/World/cameras/side"));
}

void moveCamera(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomXformable camera(stage->GetPrimAtPath(SdfPath("/World/cameras/main")));
    bool resets = false;
    const std::vector<UsdGeomXformOp> ops = camera.GetOrderedXformOps(&resets);
    if (!ops.empty()) ops.front().Set(GfVec3d(random.vec3(-1.0f, 1.0f)) + GfVec3d(0.0, 2.0, 8.0));
}

void changeLens(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomCamera camera(stage->GetPrimAtPath(SdfPath("/World/cameras/main")));
    switch (random.index(3)) {
    case 0: camera.GetFocalLengthAttr().Set(random.real(20.0f, 60.0f)); break;
    case 1:
        camera.CreateProjectionAttr().Set(random.chance(0.8f) ? UsdGeomTokens->perspective
                                                              : UsdGeomTokens->orthographic);
        break;
    default:
        camera.CreateFStopAttr().Set(random.chance(0.5f) ? 0.0f : 2.8f);
        camera.CreateFocusDistanceAttr().Set(8.0f);
    }
}

void resize(const UsdStageRefPtr&, Host& host, Random& random) {
    static const std::vector<std::pair<int, int>> sizes = {{24, 24}, {32, 16}, {16, 32},
                                                           {1, 1},   {0, 0},   {33, 0}};
    const auto [width, height] = random.pick(sizes);
    host.setSize(width, height);
}

void changeOutputs(const UsdStageRefPtr&, Host& host, Random& random) {
    std::vector<HostAov> aovs = {{"color", HdFormatFloat32Vec4}};
    if (random.chance(0.4f)) aovs.push_back({"depth", HdFormatFloat32});
    if (random.chance(0.4f)) aovs.push_back({"primId", HdFormatInt32});
    if (random.chance(0.3f)) aovs.push_back({"normal", HdFormatInvalid});
    if (random.chance(0.2f)) aovs.push_back({"noSuchOutput", HdFormatInvalid});
    if (random.chance(0.1f)) aovs.erase(aovs.begin());
    host.setAovs(aovs);
}

void changePurposes(const UsdStageRefPtr&, Host& host, Random& random) {
    std::vector<std::string> purposes = {"default"};
    for (const char* purpose : {"render", "proxy", "guide"})
        if (random.chance(0.5f)) purposes.push_back(purpose);
    host.setPurposes(purposes);
}

void changeSetting(const UsdStageRefPtr&, Host& host, Random& random) {
    switch (random.index(5)) {
    case 0: host.setSetting("maxDepth", VtValue(random.index(6))); break;
    case 1: host.setSetting("enableShadows", VtValue(random.chance(0.8f))); break;
    case 2: host.setSetting("enableSceneMaterials", VtValue(random.chance(0.8f))); break;
    case 3: host.setSetting("samples", VtValue(1 + random.index(4))); break;
    default: host.setSetting("maxDepth", VtValue(std::string("many"))); // refused with a warning
    }
}

void changeRefinement(const UsdStageRefPtr&, Host& host, Random& random) {
    host.setRefineLevel(random.index(3));
}

void pause(const UsdStageRefPtr&, Host& host, Random& random) {
    host.delegate()->Pause();
    for (int i = random.index(3); i > 0; --i)
        host.execute();
    host.delegate()->Resume();
}

void stop(const UsdStageRefPtr&, Host& host, Random& random) {
    host.delegate()->Stop(random.chance(0.5f));
    for (int i = random.index(3); i > 0; --i)
        host.execute();
    host.delegate()->Restart();
}

} // namespace

const std::vector<Edit>& hostEdits() {
    static const std::vector<Edit> edits = {
        {"switchCamera", switchCamera},
        {"moveCamera", moveCamera},
        {"changeLens", changeLens},
        {"resize", resize},
        {"changeOutputs", changeOutputs},
        {"changePurposes", changePurposes},
        {"changeSetting", changeSetting},
        {"changeRefinement", changeRefinement},
        {"pause", pause},
        {"stop", stop},
    };
    return edits;
}

} // namespace patina
