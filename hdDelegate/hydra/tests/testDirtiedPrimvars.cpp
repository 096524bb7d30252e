// SPDX-License-Identifier: Apache-2.0
// Edits of primvars that scene indices name.

#include "hdDelegate/hydra/tests/fakeScene.h"

#include <pxr/base/gf/vec3f.h>
#include <pxr/imaging/hd/primvarSchema.h>
#include <pxr/imaging/hd/primvarsSchema.h>
#include <pxr/imaging/hd/retainedDataSource.h>
#include <pxr/imaging/hd/retainedSceneIndex.h>

using namespace patina;

namespace {

const SdfPath edited("/edited");

/// A value that counts how often it is fetched.
class Counted : public HdSampledDataSource {
public:
    HD_DECLARE_DATASOURCE(Counted);
    VtValue value;
    int fetched = 0;

    VtValue GetValue(Time) override {
        ++fetched;
        return value;
    }
    bool GetContributingSampleTimesForInterval(Time, Time, std::vector<Time>*) override {
        return false;
    }

private:
    explicit Counted(const VtValue& v) : value(v) {}
};

class DirtiedPrimvars : public FakeHost {
protected:
    DirtiedPrimvars() {
        const TfToken names[] = {HdTokens->points, TfToken("a"), TfToken("b")};
        const HdDataSourceBaseHandle primvars[] = {described(points, HdPrimvarSchemaTokens->vertex),
                                                   described(a, HdPrimvarSchemaTokens->constant),
                                                   described(b, HdPrimvarSchemaTokens->constant)};
        stage->AddPrims(
            {{edited, HdPrimTypeTokens->points,
              HdRetainedContainerDataSource::New(
                  HdPrimvarsSchema::GetSchemaToken(),
                  HdRetainedContainerDataSource::New(std::size(names), names, primvars))}});
        index->InsertSceneIndex(stage, SdfPath::AbsoluteRootPath());
        sync(HdChangeTracker::AllSceneDirtyBits);
        points->fetched = a->fetched = b->fetched = 0;
    }
    static HdDataSourceBaseHandle described(const HdSampledDataSourceHandle& value,
                                            const TfToken& interpolation) {
        return HdPrimvarSchema::Builder()
            .SetPrimvarValue(value)
            .SetInterpolation(HdPrimvarSchema::BuildInterpolationDataSource(interpolation))
            .Build();
    }
    void sync(HdDirtyBits bits) {
        auto* rprim = const_cast<HdRprim*>(index->GetRprim(edited));
        rprim->Sync(index->GetSceneDelegateForRprim(edited), &param(), &bits, TfToken());
    }
    /// Syncs as Hydra does after an edit of what a locator names.
    void edit(const HdDataSourceLocator& locator) {
        stage->DirtyPrims({{edited, locator}});
        sync(index->GetChangeTracker().GetRprimDirtyBits(edited) & HdChangeTracker::DirtyPrimvar);
        index->GetChangeTracker().MarkRprimClean(edited);
    }
    float valueOf(const std::string& name) {
        const auto drawn = state();
        for (const Primvar& primvar : drawn->geometry.at(edited.GetString())->primvars)
            if (primvar.name == name) return primvar.values.at(0);
        return -1.0f;
    }

    HdRetainedSceneIndexRefPtr stage = HdRetainedSceneIndex::New();
    Counted::Handle points = Counted::New(VtValue(VtVec3fArray{GfVec3f(0.0f)})),
                    a = Counted::New(VtValue(1.0f)), b = Counted::New(VtValue(2.0f));
};

} // namespace

TEST_F(DirtiedPrimvars, NoOtherIsFetched) {
    a->value = VtValue(3.0f);
    edit(HdPrimvarsSchema::GetDefaultLocator().Append(TfToken("a")));
    EXPECT_EQ(valueOf("a"), 3.0f);
    EXPECT_EQ(valueOf("b"), 2.0f);
    EXPECT_GT(a->fetched, 0);
    EXPECT_EQ(b->fetched, 0);
    EXPECT_EQ(points->fetched, 0);
}

TEST_F(DirtiedPrimvars, AllAreWhereNoneIsNamed) {
    a->value = VtValue(3.0f);
    b->value = VtValue(4.0f);
    edit(HdPrimvarsSchema::GetDefaultLocator());
    EXPECT_EQ(valueOf("a"), 3.0f);
    EXPECT_EQ(valueOf("b"), 4.0f);
}

TEST_F(DirtiedPrimvars, TwoEditsAddUp) {
    a->value = VtValue(3.0f);
    b->value = VtValue(4.0f);
    stage->DirtyPrims({{edited, HdPrimvarsSchema::GetDefaultLocator().Append(TfToken("b"))}});
    edit(HdPrimvarsSchema::GetDefaultLocator().Append(TfToken("a")));
    EXPECT_EQ(valueOf("a"), 3.0f);
    EXPECT_EQ(valueOf("b"), 4.0f);
}
