// SPDX-License-Identifier: Apache-2.0
// Values of rprims that hosts give, take away again or give in a form that nothing reads.

#include "hdDelegate/hydra/tests/fakeScene.h"

#include <pxr/base/gf/multiInterval.h>
#include <pxr/base/gf/vec3f.h>
#include <pxr/usd/sdf/assetPath.h>

using namespace patina;

namespace {

const SdfPath path("/prim");

class PrimsOfHosts : public FakeHost {
protected:
    void set(const TfToken& name, const VtValue& value) {
        scene->setPrimvar(path, name, HdInterpolationVertex, value);
    }
    template <class Prim> std::shared_ptr<const Prim> drawn() {
        const auto scene = state();
        const auto found = scene->geometry.find(path.GetString());
        return found == scene->geometry.end()
                   ? nullptr
                   : std::dynamic_pointer_cast<const Prim>(found->second);
    }
};

} // namespace

TEST_F(PrimsOfHosts, PrimvarsWithoutNumbersAreToldOf) {
    set(TfToken("odd"), VtValue(GfMultiInterval()));
    set(TfToken("label"), VtValue(std::string("text")));
    set(TfToken("labels"), VtValue(VtStringArray(2, "text")));
    set(TfToken("file"), VtValue(SdfAssetPath("a.png")));
    set(TfToken("none"), VtValue(VtFloatArray()));
    set(TfToken("good"), VtValue(VtFloatArray(3, 0.5f)));
    syncRprim(HdPrimTypeTokens->mesh, path);
    const auto mesh = drawn<Mesh>();
    ASSERT_TRUE(mesh);
    ASSERT_EQ(mesh->primvars.size(), 1u);
    EXPECT_EQ(mesh->primvars[0].name, "good");
    EXPECT_EQ(warningsOf(path, "which holds no numbers; it is left out"), 1);
    for (const Diagnostic& d : param().scene()->diagnostics().all())
        if (d.message.find("no numbers") != std::string::npos) {
            EXPECT_EQ(d.input, "primvars:odd");
        }
}

TEST_F(PrimsOfHosts, StandInsOfModelsAreThinLinesBetweenPairsOfPoints) {
    scene->curves = HdBasisCurvesTopology(HdTokens->linear, HdTokens->bezier, HdTokens->segmented,
                                          VtIntArray{4}, VtIntArray{0, 1, 0, 2});
    set(HdTokens->points,
        VtValue(VtVec3fArray{GfVec3f(0.0f), GfVec3f(3.0f, 0.0f, 0.0f), GfVec3f(0.0f, 4.0f, 0.0f)}));
    scene->setPrimvar(path, HdTokens->widths, HdInterpolationConstant, VtValue(VtFloatArray{1.0f}));
    syncRprim(HdPrimTypeTokens->basisCurves, path);
    const auto lines = drawn<Curves>();
    ASSERT_TRUE(lines);
    EXPECT_EQ(lines->curveVertexCounts, (std::vector<int>{2, 2}));
    ASSERT_TRUE(lines->primvar("widths"));
    EXPECT_EQ(lines->primvar("widths")->values, std::vector<float>{0.005f * 5.0f});
}

TEST_F(PrimsOfHosts, PointsThatAreListedNoMoreAreGone) {
    set(HdTokens->points, VtValue(VtVec3fArray(3, GfVec3f(1.0f))));
    syncRprim(HdPrimTypeTokens->mesh, path);
    ASSERT_TRUE(drawn<Mesh>());
    EXPECT_EQ(drawn<Mesh>()->points.values.size(), 1u);
    syncRprim(HdPrimTypeTokens->mesh, path, HdChangeTracker::DirtyTransform);
    EXPECT_EQ(drawn<Mesh>()->points.values.size(), 1u) << "an edit of something else";
    scene->primvars.clear();
    scene->interpolations.clear();
    syncRprim(HdPrimTypeTokens->mesh, path, HdChangeTracker::DirtyPrimvar);
    ASSERT_TRUE(drawn<Mesh>());
    EXPECT_TRUE(drawn<Mesh>()->points.empty());
}

TEST_F(PrimsOfHosts, IndicesOfCurvesAreCheckedWheneverOneOfBothChanges) {
    const auto topology = [](const VtIntArray& indices) {
        return HdBasisCurvesTopology(HdTokens->linear, HdTokens->bezier, HdTokens->nonperiodic,
                                     VtIntArray{int(indices.size())}, indices);
    };
    set(HdTokens->points, VtValue(VtVec3fArray{GfVec3f(1.0f), GfVec3f(2.0f), GfVec3f(3.0f)}));
    scene->curves = topology({2, 0});
    syncRprim(HdPrimTypeTokens->basisCurves, path);
    ASSERT_TRUE(drawn<Curves>());
    const std::vector<vec3> ordered = {vec3(3.0f), vec3(1.0f)};
    EXPECT_EQ(drawn<Curves>()->points.first(), ordered);
    EXPECT_EQ(warningsOf(path, "index out of range; the first point"), 0);

    scene->curves = topology({2, 7, -1});
    syncRprim(HdPrimTypeTokens->basisCurves, path, HdChangeTracker::DirtyTopology);
    const std::vector<vec3> mended = {vec3(3.0f), vec3(1.0f), vec3(1.0f)};
    EXPECT_EQ(drawn<Curves>()->points.first(), mended);
    EXPECT_EQ(warningsOf(path, "has an index out of range; the first point is used there"), 1);

    set(HdTokens->points, VtValue(VtVec3fArray(8, GfVec3f(4.0f))));
    syncRprim(HdPrimTypeTokens->basisCurves, path,
              HdChangeTracker::DirtyPoints | HdChangeTracker::DirtyPrimvar);
    const std::vector<vec3> moved(3, vec3(4.0f));
    EXPECT_EQ(drawn<Curves>()->points.first(), moved);
}
