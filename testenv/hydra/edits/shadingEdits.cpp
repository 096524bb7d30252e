// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/edits.h"

#include "hdDelegate/hydra/compat.h"

#include <pxr/usd/usdGeom/xformable.h>
#include <pxr/usd/usdLux/lightAPI.h>
#include <pxr/usd/usdLux/shapingAPI.h>
#include <pxr/usd/usdLux/sphereLight.h>
#include <pxr/usd/usdShade/connectableAPI.h>
#include <pxr/usd/usdShade/materialBindingAPI.h>
#include <pxr/usd/usdShade/shader.h>

namespace patina {

namespace {

const std::vector<const char*>& materialNames() {
    static const std::vector<const char*> names = {"preview", "standard", "closure", "missing"};
    return names;
}

UsdShadeShader shaderAt(const UsdStageRefPtr& stage, const char* path) {
    return UsdShadeShader(stage->GetPrimAtPath(SdfPath(std::string("/World/materials/") + path)));
}

void setColor(UsdShadeShader shader, const char* input, Random& random) {
    if (!shader) return;
    shader.CreateInput(TfToken(input), SdfValueTypeNames->Color3f).Set(random.vec3(0.0f, 1.0f));
}

void setFloat(UsdShadeShader shader, const char* input, Random& random) {
    if (!shader) return;
    shader.CreateInput(TfToken(input), SdfValueTypeNames->Float).Set(random.real(0.0f, 1.0f));
}

void changeParameter(const UsdStageRefPtr& stage, Host&, Random& random) {
    switch (random.index(6)) {
    case 0: setColor(shaderAt(stage, "preview/surface"), "diffuseColor", random); break;
    case 1: setFloat(shaderAt(stage, "preview/surface"), "roughness", random); break;
    case 2: setColor(shaderAt(stage, "standard/surface"), "base_color", random); break;
    case 3: setFloat(shaderAt(stage, "standard/surface"), "transmission", random); break;
    case 4: setFloat(shaderAt(stage, "standard/surface"), "coat", random); break;
    default: setColor(shaderAt(stage, "closure/diffuse"), "color", random);
    }
}

void changeOpacity(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdShadeShader shader = shaderAt(stage, "preview/surface");
    if (random.chance(0.5f))
        setFloat(shader, "opacity", random);
    else
        shader.GetPrim().RemoveProperty(TfToken("inputs:opacity"));
}

void changeConnection(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdShadeInput color =
        shaderAt(stage, "preview/surface").GetInput(TfToken("diffuseColor"));
    if (!color) return;
    if (random.chance(0.5f))
        color.ConnectToSource(SdfPath("/World/materials/preview/reader.outputs:result"));
    else
        color.ClearSources();
}

void changeNode(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const TfTokenVector ids = {TfToken("ND_oren_nayar_diffuse_bsdf"),
                                      TfToken("ND_burley_diffuse_bsdf"), TfToken("ND_sheen_bsdf"),
                                      TfToken("ND_conductor_bsdf"), TfToken("ND_no_such_bsdf")};
    shaderAt(stage, "closure/diffuse").SetShaderId(random.pick(ids));
}

/// Connects the layers in a ring now and then: a network that cannot be.
void changeLayer(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<const char*> sources = {"diffuse", "gloss", "layer", "nothing"};
    const UsdShadeInput base =
        shaderAt(stage, "closure/layer").CreateInput(TfToken("base"), SdfValueTypeNames->Token);
    base.ConnectToSource(
        SdfPath(std::string("/World/materials/closure/") + random.pick(sources) + ".outputs:out"));
}

void rebind(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<const char*> prims = {
        "/World/geometry/ground", "/World/geometry/polygons", "/World/geometry/sphere",
        "/World/geometry/curves", "/World/instancer/block",   "/World/geometry/subdivided/part"};
    const UsdPrim prim = stage->GetPrimAtPath(SdfPath(random.pick(prims)));
    UsdShadeMaterialBindingAPI api = UsdShadeMaterialBindingAPI::Apply(prim);
    if (random.chance(0.2f)) {
        api.UnbindDirectBinding();
        return;
    }
    prim.CreateRelationship(TfToken("material:binding"), false)
        .SetTargets({SdfPath(std::string("/World/materials/") + random.pick(materialNames()))});
}

void toggleMaterial(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdPrim prim = stage->GetPrimAtPath(
        SdfPath(std::string("/World/materials/") + random.pick(materialNames())));
    if (prim) prim.SetActive(random.chance(0.7f));
}

UsdPrim anyLight(const UsdStageRefPtr& stage, Random& random) {
    static const std::vector<const char*> names = {"key", "bulb", "sun", "sky"};
    return stage->GetPrimAtPath(SdfPath(std::string("/World/lights/") + random.pick(names)));
}

void changeLight(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdLuxLightAPI light(anyLight(stage, random));
    switch (random.index(4)) {
    case 0: light.CreateIntensityAttr().Set(random.real(0.0f, 20.0f)); break;
    case 1: light.CreateColorAttr().Set(random.vec3(0.0f, 1.0f)); break;
    case 2: light.CreateNormalizeAttr().Set(random.chance(0.5f)); break;
    default: light.CreateExposureAttr().Set(random.real(-1.0f, 1.0f));
    }
}

void shapeLight(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdLuxShapingAPI::Apply(anyLight(stage, random))
        .CreateShapingConeAngleAttr()
        .Set(random.real(10.0f, 90.0f));
}

void moveLight(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdGeomXformable light(stage->GetPrimAtPath(
        SdfPath(random.chance(0.5f) ? "/World/lights/key" : "/World/lights/bulb")));
    bool resets = false;
    const std::vector<UsdGeomXformOp> ops = light.GetOrderedXformOps(&resets);
    if (!ops.empty()) ops.front().Set(GfVec3d(random.vec3(1.0f, 4.0f)));
}

void linkLight(const UsdStageRefPtr& stage, Host& host, Random& random) {
    if (!PATINA_HAS_LATE_COLLECTIONS && host.options().sceneIndex) return;
    const UsdCollectionAPI links =
        UsdLuxLightAPI(anyLight(stage, random)).GetLightLinkCollectionAPI();
    if (random.chance(0.5f)) {
        links.CreateIncludeRootAttr().Set(true);
        links.CreateExcludesRel().SetTargets({SdfPath("/World/geometry/sphere")});
    } else {
        links.CreateExcludesRel().ClearTargets(true);
    }
}

void addOrRemoveLight(const UsdStageRefPtr& stage, Host&, Random& random) {
    const SdfPath path("/World/lights/added" + std::to_string(random.index(3)));
    if (stage->GetPrimAtPath(path)) {
        stage->RemovePrim(path);
        return;
    }
    const UsdLuxSphereLight light = UsdLuxSphereLight::Define(stage, path);
    light.CreateRadiusAttr().Set(random.real(0.05f, 0.3f));
    light.CreateIntensityAttr().Set(random.real(1.0f, 10.0f));
    light.AddTranslateOp().Set(GfVec3d(random.vec3(1.0f, 3.0f)));
}

} // namespace

const std::vector<Edit>& shadingEdits() {
    static const std::vector<Edit> edits = {
        {"changeParameter", changeParameter},
        {"changeOpacity", changeOpacity},
        {"changeConnection", changeConnection},
        {"changeNode", changeNode},
        {"changeLayer", changeLayer},
        {"rebind", rebind},
        {"toggleMaterial", toggleMaterial},
        {"changeLight", changeLight},
        {"shapeLight", shapeLight},
        {"moveLight", moveLight},
        {"linkLight", linkLight},
        {"addOrRemoveLight", addOrRemoveLight},
    };
    return edits;
}

} // namespace patina
