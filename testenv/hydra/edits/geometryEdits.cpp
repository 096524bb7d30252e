// SPDX-License-Identifier: Apache-2.0
#include "testenv/hydra/edits/edits.h"

#include <pxr/usd/usdGeom/cube.h>
#include <pxr/usd/usdGeom/gprim.h>
#include <pxr/usd/usdGeom/mesh.h>
#include <pxr/usd/usdGeom/plane.h>
#include <pxr/usd/usdGeom/primvarsAPI.h>
#include <pxr/usd/usdGeom/sphere.h>
#include <pxr/usd/usdGeom/tokens.h>
#include <pxr/usd/usdGeom/xformCommonAPI.h>

#include <limits>

namespace patina {

namespace {

const char* const folder = "/World/geometry/";

UsdPrim geometryPrim(const UsdStageRefPtr& stage, const char* name) {
    return stage->GetPrimAtPath(SdfPath(std::string(folder) + name));
}

UsdPrim anyGprim(const UsdStageRefPtr& stage, Random& random) {
    static const std::vector<const char*> names = {"ground", "polygons", "subdivided", "sphere",
                                                   "cube",   "curves",   "points"};
    return geometryPrim(stage, random.pick(names));
}

UsdPrim anyPointBased(const UsdStageRefPtr& stage, Random& random) {
    static const std::vector<const char*> names = {"polygons", "subdivided", "curves", "points"};
    return geometryPrim(stage, random.pick(names));
}

void move(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<const char*> names = {"/World/geometry/sphere", "/World/geometry/cube",
                                                   "/World/native/a", "/World/native/b",
                                                   "/World/variants"};
    const UsdGeomXformable prim(stage->GetPrimAtPath(SdfPath(random.pick(names))));
    bool resets = false;
    const std::vector<UsdGeomXformOp> ops = prim.GetOrderedXformOps(&resets);
    if (!ops.empty()) ops.front().Set(GfVec3d(random.vec3(-2.0f, 2.0f)));
}

void flipHandedness(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomGprim(anyGprim(stage, random))
        .CreateOrientationAttr()
        .Set(random.chance(0.5f) ? UsdGeomTokens->leftHanded : UsdGeomTokens->rightHanded);
}

void makeDoubleSided(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomGprim(anyGprim(stage, random)).CreateDoubleSidedAttr().Set(random.chance(0.5f));
}

void movePoints(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomPointBased prim(anyPointBased(stage, random));
    VtVec3fArray points;
    prim.GetPointsAttr().Get(&points);
    for (GfVec3f& point : points)
        point += random.vec3(-0.05f, 0.05f);
    prim.GetPointsAttr().Set(points);
}

void breakPoint(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomPointBased prim(anyPointBased(stage, random));
    VtVec3fArray points;
    prim.GetPointsAttr().Get(&points);
    if (!points.empty())
        points[size_t(random.index(points.size()))][1] = std::numeric_limits<float>::quiet_NaN();
    prim.GetPointsAttr().Set(points);
}

/// A new grid of another size, sometimes with an index or a count that is wrong.
void changeTopology(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomMesh mesh(geometryPrim(stage, random.chance(0.5f) ? "polygons" : "subdivided"));
    const int columns = 1 + random.index(4), rows = 1 + random.index(3);
    VtVec3fArray points;
    for (int y = 0; y <= rows; ++y)
        for (int x = 0; x <= columns; ++x)
            points.push_back(GfVec3f(-1.0f + 0.4f * float(x), 0.2f + 0.4f * float(y), 0.0f) +
                             random.vec3(-0.05f, 0.05f));
    VtIntArray counts, indices;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const int first = y * (columns + 1) + x;
            counts.push_back(4);
            for (int index : {first, first + 1, first + columns + 2, first + columns + 1})
                indices.push_back(index);
        }
    if (random.chance(0.1f)) indices[0] = 1000;
    if (random.chance(0.1f)) counts[0] = 7;
    mesh.GetPointsAttr().Set(points);
    mesh.GetFaceVertexCountsAttr().Set(counts);
    mesh.GetFaceVertexIndicesAttr().Set(indices);
}

void changeScheme(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const TfTokenVector schemes = {UsdGeomTokens->none, UsdGeomTokens->catmullClark,
                                          UsdGeomTokens->loop, UsdGeomTokens->bilinear};
    UsdGeomMesh(geometryPrim(stage, random.chance(0.5f) ? "polygons" : "subdivided"))
        .CreateSubdivisionSchemeAttr()
        .Set(random.pick(schemes));
}

/// Of any interpolation; counts may or may not fit.
void changeColor(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const TfTokenVector interpolations = {UsdGeomTokens->constant, UsdGeomTokens->uniform,
                                                 UsdGeomTokens->varying, UsdGeomTokens->vertex,
                                                 UsdGeomTokens->faceVarying};
    const UsdGeomPrimvarsAPI api(anyGprim(stage, random));
    const TfToken interpolation = random.pick(interpolations);
    VtVec3fArray colors(interpolation == UsdGeomTokens->constant ? 1 : 1 + random.index(24));
    for (GfVec3f& color : colors)
        color = random.vec3(0.0f, 1.0f);
    api.CreatePrimvar(TfToken("displayColor"), SdfValueTypeNames->Color3fArray)
        .SetInterpolation(interpolation);
    api.GetPrimvar(TfToken("displayColor")).Set(colors);
}

void dropColor(const UsdStageRefPtr& stage, Host&, Random& random) {
    UsdGeomPrimvarsAPI(anyGprim(stage, random)).RemovePrimvar(TfToken("displayColor"));
}

void changeShape(const UsdStageRefPtr& stage, Host&, Random& random) {
    const double size = double(random.real(0.1f, 0.8f));
    switch (random.index(3)) {
    case 0: UsdGeomSphere(geometryPrim(stage, "sphere")).GetRadiusAttr().Set(size); break;
    case 1: UsdGeomCube(geometryPrim(stage, "cube")).GetSizeAttr().Set(size); break;
    default: UsdGeomPlane(geometryPrim(stage, "pane")).GetWidthAttr().Set(size);
    }
}

void changeVisibility(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const std::vector<const char*> names = {"/World/geometry/sphere",   "/World/instancer",
                                                   "/World/geometry/polygons", "/World/native",
                                                   "/World/lights/key",        "/World/geometry"};
    UsdGeomImageable(stage->GetPrimAtPath(SdfPath(random.pick(names))))
        .CreateVisibilityAttr()
        .Set(random.chance(0.4f) ? UsdGeomTokens->invisible : UsdGeomTokens->inherited);
}

void changePurpose(const UsdStageRefPtr& stage, Host&, Random& random) {
    static const TfTokenVector purposes = {UsdGeomTokens->default_, UsdGeomTokens->render,
                                           UsdGeomTokens->proxy, UsdGeomTokens->guide};
    UsdGeomImageable(anyGprim(stage, random)).CreatePurposeAttr().Set(random.pick(purposes));
}

void changeSubset(const UsdStageRefPtr& stage, Host&, Random& random) {
    const UsdPrim subset = geometryPrim(stage, "subdivided/part");
    VtIntArray faces;
    for (int i = random.index(4); i > 0; --i)
        faces.push_back(random.index(8)); // may repeat, and may be out of range
    subset.GetAttribute(TfToken("indices")).Set(faces);
}

} // namespace

const std::vector<Edit>& geometryEdits() {
    static const std::vector<Edit> edits = {
        {"move", move},
        {"flipHandedness", flipHandedness},
        {"makeDoubleSided", makeDoubleSided},
        {"movePoints", movePoints},
        {"breakPoint", breakPoint},
        {"changeTopology", changeTopology},
        {"changeScheme", changeScheme},
        {"changeColor", changeColor},
        {"dropColor", dropColor},
        {"changeShape", changeShape},
        {"changeVisibility", changeVisibility},
        {"changePurpose", changePurpose},
        {"changeSubset", changeSubset},
    };
    return edits;
}

} // namespace patina
