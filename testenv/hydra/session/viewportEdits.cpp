// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/session/viewportEdits.h"

#include <pxr/usd/usdGeom/mesh.h>
#include <pxr/usd/usdGeom/xformable.h>
#include <pxr/usd/usdLux/domeLight.h>
#include <pxr/usd/usdLux/sphereLight.h>
#include <pxr/usd/usdShade/material.h>
#include <pxr/usd/usdShade/materialBindingAPI.h>
#include <pxr/usd/usdShade/shader.h>

#include <OpenImageIO/imageio.h>

#include <set>
#include <stdexcept>

namespace patina {

namespace {

constexpr int textureCount = 4;
std::vector<std::string>& textures() {
    static std::vector<std::string> files;
    return files;
}

/// Names come back after a while: OpenUSD keeps a record of each path that a stage ever had.
std::string newName(const char* kind) {
    static int count = 0;
    return kind + std::to_string(++count % 32);
}

void drag(const UsdStageRefPtr& stage, Host& host, Random& random, const char* path) {
    const UsdGeomXformable prim(stage->GetPrimAtPath(SdfPath(path)));
    if (!prim) return;
    bool resets = false;
    const std::vector<UsdGeomXformOp> ops = prim.GetOrderedXformOps(&resets);
    GfVec3d place(0.0);
    if (ops.empty() || !ops.front().Get(&place)) return;
    const GfVec3d step(random.vec3(-0.1f, 0.1f));
    for (int i = 3 + random.index(4); i > 0; --i) {
        ops.front().Set(place += step);
        host.execute();
    }
}

void dragCamera(const UsdStageRefPtr& stage, Host& host, Random& random) {
    drag(stage, host, random, "/World/cameras/main");
}

void dragPrim(const UsdStageRefPtr& stage, Host& host, Random& random) {
    static const std::vector<const char*> paths = {"/World/geometry/sphere", "/World/geometry/cube",
                                                   "/World/lights/bulb", "/World/native/a"};
    drag(stage, host, random, random.pick(paths));
}

void dragSlider(const UsdStageRefPtr& stage, Host& host, Random& random) {
    UsdShadeShader shader(stage->GetPrimAtPath(SdfPath("/World/materials/standard/surface")));
    if (!shader) return;
    const UsdShadeInput input =
        shader.CreateInput(TfToken("specular_roughness"), SdfValueTypeNames->Float);
    for (int i = 3 + random.index(4); i > 0; --i) {
        input.Set(random.real(0.0f, 1.0f));
        host.execute();
    }
}

void dragCorner(const UsdStageRefPtr&, Host& host, Random& random) {
    int width = 32 + random.index(64), height = 24 + random.index(48);
    for (int i = 2 + random.index(3); i > 0; --i) {
        host.setSize(width += random.index(9), height += random.index(7));
        host.execute();
    }
}

/// Points that move with time, and a timeline that runs.
void play(const UsdStageRefPtr& stage, Host& host, Random& random) {
    const UsdGeomMesh mesh(stage->GetPrimAtPath(SdfPath("/World/geometry/polygons")));
    VtVec3fArray points;
    if (!mesh || !mesh.GetPointsAttr().Get(&points)) return;
    constexpr int frames = 4;
    for (int frame = 1; frame <= frames; ++frame) {
        for (GfVec3f& point : points)
            point += random.vec3(-0.05f, 0.05f);
        mesh.GetPointsAttr().Set(points, double(frame));
    }
    for (int frame = 1; frame <= frames; ++frame) {
        host.setTime(double(frame));
        host.execute();
    }
}

UsdShadeShader define(const UsdStageRefPtr& stage, const SdfPath& path, const char* id) {
    UsdShadeShader shader = UsdShadeShader::Define(stage, path);
    shader.CreateIdAttr().Set(TfToken(id));
    return shader;
}

/// @param material path of a material with UsdPreviewSurface in "surface"
void connectTexture(const UsdStageRefPtr& stage, const SdfPath& material, const std::string& file) {
    UsdShadeShader surface(stage->GetPrimAtPath(material.AppendChild(TfToken("surface"))));
    if (!surface) return;
    UsdShadeShader uv =
        define(stage, material.AppendChild(TfToken("uv")), "UsdPrimvarReader_float2");
    uv.CreateInput(TfToken("varname"), SdfValueTypeNames->String).Set(std::string("st"));
    UsdShadeShader image = define(stage, material.AppendChild(TfToken("image")), "UsdUVTexture");
    image.CreateInput(TfToken("file"), SdfValueTypeNames->Asset).Set(SdfAssetPath(file));
    image.CreateInput(TfToken("st"), SdfValueTypeNames->Float2)
        .ConnectToSource(uv.CreateOutput(TfToken("result"), SdfValueTypeNames->Float2));
    surface.CreateInput(TfToken("diffuseColor"), SdfValueTypeNames->Color3f)
        .ConnectToSource(image.CreateOutput(TfToken("rgb"), SdfValueTypeNames->Float3));
}

void swapTexture(const UsdStageRefPtr& stage, Host&, Random& random) {
    connectTexture(stage, SdfPath("/World/materials/preview"), random.pick(textures()));
}

void swapSky(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdLuxDomeLight sky(stage->GetPrimAtPath(SdfPath("/World/lights/sky")));
    if (sky) sky.CreateTextureFileAttr().Set(SdfAssetPath(random.pick(textures())));
}

/// A mesh with a material of its own; sometimes its texture is missing, which is warned about.
void importPrim(const UsdStageRefPtr& stage, Host&, Random& random) {
    const SdfPath root("/World/extra/" + newName("imported"));
    UsdGeomMesh mesh = UsdGeomMesh::Define(stage, root);
    const GfVec3f place = random.vec3(-1.5f, 1.5f);
    VtVec3fArray points;
    for (const GfVec3f corner :
         {GfVec3f(0, 0, 0), GfVec3f(1, 0, 0), GfVec3f(1, 1, 0.2f), GfVec3f(0, 1, 0)})
        points.push_back(place + corner);
    mesh.CreatePointsAttr().Set(points);
    mesh.CreateFaceVertexCountsAttr().Set(VtIntArray{4});
    mesh.CreateFaceVertexIndicesAttr().Set(VtIntArray{0, 1, 2, 3});
    UsdShadeMaterial material = UsdShadeMaterial::Define(stage, root.AppendChild(TfToken("look")));
    UsdShadeShader surface =
        define(stage, material.GetPath().AppendChild(TfToken("surface")), "UsdPreviewSurface");
    surface.CreateInput(TfToken("diffuseColor"), SdfValueTypeNames->Color3f)
        .Set(random.vec3(0.0f, 1.0f));
    material.CreateSurfaceOutput().ConnectToSource(
        surface.CreateOutput(TfToken("surface"), SdfValueTypeNames->Token));
    connectTexture(stage, material.GetPath(),
                   random.chance(0.2f) ? "missing.png" : random.pick(textures()));
    UsdShadeMaterialBindingAPI::Apply(mesh.GetPrim()).Bind(material);
}

void importLight(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdLuxSphereLight light =
        UsdLuxSphereLight::Define(stage, SdfPath("/World/lights/" + newName("imported")));
    light.CreateRadiusAttr().Set(random.real(0.05f, 0.3f));
    light.AddTranslateOp().Set(GfVec3d(random.vec3(1.0f, 3.0f)));
}

/// One of the prims that were imported.
void deletePrim(const UsdStageRefPtr& stage, Host&, Random& random) {
    std::vector<SdfPath> paths;
    for (const UsdPrim& prim : stage->GetPrimAtPath(SdfPath("/World/extra")).GetChildren())
        paths.push_back(prim.GetPath());
    if (!paths.empty()) stage->RemovePrim(random.pick(paths));
}

} // namespace

const std::vector<Edit>& viewportEdits() {
    static const std::vector<Edit> edits = {
        {"dragCamera", dragCamera},
        {"dragPrim", dragPrim},
        {"dragSlider", dragSlider},
        {"dragCorner", dragCorner},
        {"play", play},
        {"swapTexture", swapTexture},
        {"swapSky", swapSky},
        {"importPrim", importPrim},
        {"importLight", importLight},
        {"deletePrim", deletePrim},
    };
    return edits;
}

std::vector<Edit> sessionEdits() {
    // The first replaces the root layer. With the others OpenUSD's own indices go astray.
    static const std::set<std::string> left = {"startOver", "changePrototypes",
                                               "toggleInstanceable"};
    std::vector<Edit> all;
    for (const auto* group :
         {&geometryEdits(), &shadingEdits(), &structureEdits(), &hostEdits(), &viewportEdits()})
        for (const Edit& edit : *group)
            if (!left.count(edit.name)) all.push_back(edit);
    return all;
}

void writeTextures(const std::string& folder) {
    constexpr int width = 96, height = 64; // more than one tile
    for (int i = 0; i < textureCount; ++i) {
        std::vector<uint8_t> pixels;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int channel = 0; channel < 3; ++channel)
                    pixels.push_back(uint8_t((x * (i + 1) + y * (channel + 1)) & 255));
        const std::string file = folder + "/texture" + std::to_string(i) + ".png";
        const auto out = OIIO::ImageOutput::create(file);
        if (!out || !out->open(file, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8)) ||
            !out->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !out->close())
            throw std::runtime_error(file + " cannot be written");
        textures().push_back(file);
    }
}

void startOver(const UsdStageRefPtr& stage, Host& host, const HostOptions& start) {
    stage->GetSessionLayer()->Clear();
    host.setCamera(start.camera);
    host.setSize(start.width, start.height);
    host.setAovs(start.aovs);
    host.setPurposes(start.purposes);
    host.setTime(start.time);
    host.setRefineLevel(start.refineLevel);
    for (const auto& [name, value] : start.settings)
        host.setSetting(name.GetString(), value);
}

} // namespace patina
