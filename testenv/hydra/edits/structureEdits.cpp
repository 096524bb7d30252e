// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/baseStage.h"
#include "testenv/hydra/edits/edits.h"

#include <pxr/usd/usd/variantSets.h>
#include <pxr/usd/usdGeom/mesh.h>
#include <pxr/usd/usdGeom/pointInstancer.h>
#include <pxr/usd/usdGeom/sphere.h>

namespace patina {

namespace {

UsdGeomPointInstancer instancerOf(const UsdStageRefPtr& stage, Random& random) {
    return UsdGeomPointInstancer(stage->GetPrimAtPath(
        SdfPath(random.chance(0.6f) ? "/World/instancer" : "/World/instancer/cluster")));
}

void moveInstances(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomPointInstancer instancer = instancerOf(stage, random);
    if (!instancer) return;
    VtVec3fArray positions;
    instancer.GetPositionsAttr().Get(&positions);
    for (GfVec3f& position : positions)
        position += random.vec3(-0.1f, 0.1f);
    instancer.GetPositionsAttr().Set(positions);
}

/// Another number of instances; prototypes may be out of range and orientations too few.
void changeInstances(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomPointInstancer instancer = instancerOf(stage, random);
    if (!instancer) return;
    VtVec3fArray positions(size_t(random.index(6)));
    VtIntArray indices;
    for (GfVec3f& position : positions) {
        position = random.vec3(-0.5f, 2.5f);
        indices.push_back(random.chance(0.05f) ? 9 : random.index(2));
    }
    instancer.GetPositionsAttr().Set(positions);
    instancer.GetProtoIndicesAttr().Set(indices);
    if (random.chance(0.8f))
        instancer.CreateOrientationsAttr().Set(VtQuathArray(positions.size(), GfQuath(1.0f)));
    if (random.chance(0.8f))
        instancer.CreateScalesAttr().Set(
            VtVec3fArray(positions.size(), GfVec3f(random.real(0.5f, 1.5f))));
}

void hideInstance(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomPointInstancer instancer = instancerOf(stage, random);
    if (!instancer) return;
    VtInt64Array hidden;
    if (random.chance(0.7f)) hidden.push_back(random.index(3));
    instancer.CreateInvisibleIdsAttr().Set(hidden);
}

void changePrototypes(const UsdStageRefPtr& stage, Host& host, Random& random) {
    const UsdGeomPointInstancer instancer(stage->GetPrimAtPath(SdfPath("/World/instancer")));
    if (!instancer) return;
    SdfPathVector targets = {SdfPath("/World/instancer/block"),
                             SdfPath("/World/instancer/cluster")};
    if (random.chance(0.5f)) std::swap(targets[0], targets[1]);
    if (random.chance(0.2f)) targets.pop_back();
    // UsdImagingDelegate forgets where a nested instancer is drawn when prototypes change places
    // (seen in 24.11): there the instancer goes and comes again.
    const bool wasActive = instancer.GetPrim().IsActive();
    const UsdPrim prim = instancer.GetPrim();
    instancer.GetPrototypesRel().SetTargets(targets);
    if (host.options().sceneIndex || !wasActive) return;
    prim.SetActive(false);
    host.execute();
    stage->GetPrimAtPath(SdfPath("/World/instancer")).SetActive(true);
}

void toggleInstanceable(const UsdStageRefPtr& stage, Host& host, Random& random) {
    // UsdImaging's scene index goes on counting a native instance that is none any more (seen in
    // 24.11: the indices that it gives differ from those of a fresh one).
    if (host.options().sceneIndex) return;
    const UsdPrim prim =
        stage->GetPrimAtPath(SdfPath(random.chance(0.5f) ? "/World/native/a" : "/World/native/b"));
    if (prim) prim.SetInstanceable(random.chance(0.6f));
}

void addOrRemoveNative(const UsdStageRefPtr& stage, Host&, Random& random) {
    const SdfPath path("/World/native/added" + std::to_string(random.index(3)));
    if (stage->GetPrimAtPath(path)) {
        stage->RemovePrim(path);
        return;
    }
    const UsdGeomXformable prim(stage->DefinePrim(path, TfToken("Xform")));
    prim.GetPrim().GetReferences().AddInternalReference(SdfPath("/Library/thing"));
    prim.GetPrim().SetInstanceable(true);
    prim.AddTranslateOp().Set(GfVec3d(random.vec3(0.0f, 2.0f)));
}

void editLibrary(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomMesh flag(stage->GetPrimAtPath(SdfPath("/Library/thing/flag")));
    VtVec3fArray points = {GfVec3f(0.0f, 0.4f, 0.1f), GfVec3f(0.4f, 0.5f, 0.1f),
                           GfVec3f(0.0f, 0.6f, 0.1f)};
    for (GfVec3f& point : points)
        point += random.vec3(-0.1f, 0.1f);
    if (flag) flag.GetPointsAttr().Set(points);
}

void addOrRemovePrim(const UsdStageRefPtr& stage, Host&, Random& random) {
    const SdfPath path("/World/extra/added" + std::to_string(random.index(4)));
    if (stage->GetPrimAtPath(path)) {
        stage->RemovePrim(path);
        return;
    }
    const UsdGeomSphere sphere = UsdGeomSphere::Define(stage, path);
    sphere.CreateRadiusAttr().Set(double(random.real(0.1f, 0.4f)));
    sphere.AddTranslateOp().Set(GfVec3d(random.vec3(-2.0f, 2.0f)));
}

/// Another type at the same path within one notice.
void retype(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const TfTokenVector types = {TfToken("Cube"), TfToken("Sphere"), TfToken("Cone"),
                                        TfToken("SphereLight"), TfToken("Xform")};
    stage->DefinePrim(SdfPath("/World/extra/retyped"), random.pick(types));
}

void changeVariant(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<std::string> looks = {"cone", "capsule", "none", "unknown"};
    UsdPrim prim = stage->GetPrimAtPath(SdfPath("/World/variants"));
    if (prim) prim.GetVariantSet("look").SetVariantSelection(random.pick(looks));
}

void toggleActive(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<const char*> names = {"/World/geometry/polygons", "/World/instancer",
                                                   "/World/native", "/World/lights/sky"};
    stage->GetPrimAtPath(SdfPath(random.pick(names))).SetActive(random.chance(0.7f));
}

/// Everything goes and comes back as it was in the beginning: one notice for the whole stage.
void startOver(const UsdStageRefPtr& stage, Host&, Random& random) {
    if (random.chance(0.2f))
        stage->GetRootLayer()->TransferContent(makeBaseStage()->GetRootLayer());
}

} // namespace

const std::vector<Edit>& structureEdits() {
    static const std::vector<Edit> edits = {
        {"moveInstances", moveInstances},
        {"changeInstances", changeInstances},
        {"hideInstance", hideInstance},
        {"changePrototypes", changePrototypes},
        {"toggleInstanceable", toggleInstanceable},
        {"addOrRemoveNative", addOrRemoveNative},
        {"editLibrary", editLibrary},
        {"addOrRemovePrim", addOrRemovePrim},
        {"retype", retype},
        {"changeVariant", changeVariant},
        {"toggleActive", toggleActive},
        {"startOver", startOver},
    };
    return edits;
}

} // namespace patina
