// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/primMarks.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

struct MarkedPrim {
    Mesh prim;
    Diagnostics diagnostics;

    explicit MarkedPrim(const Marks& marks) {
        prim.path = "/prim";
        applyMarks(marks, prim, prim.path, diagnostics);
    }
    unsigned rays() const { return prim.visibility.mask(); }
};

unsigned karma(const std::string& text) {
    return MarkedPrim({{"karma:object:rendervisibility", text}}).rays();
}

} // namespace

TEST(PrimMarks, EveryRendererHidesFromTheRaysThatItNames) {
    EXPECT_EQ(MarkedPrim({}).rays(), unsigned(RayAny));
    EXPECT_EQ(MarkedPrim({{"arnold:visibility:camera", 0.0}}).rays(), RayAny & ~RayCamera);
    EXPECT_EQ(MarkedPrim({{"arnold:visibility:specular_reflect", 0.0}}).rays(),
              RayAny & ~RaySpecular);
    EXPECT_EQ(MarkedPrim({{"arnold:visibility", 255.0 - 2.0}}).rays(), RayAny & ~RayShadow);
    EXPECT_EQ(MarkedPrim({{"ri:attributes:visibility:transmission", 0.0}}).rays(),
              RayAny & ~RayShadow);
    EXPECT_EQ(MarkedPrim({{"ri:attributes:visibility:indirect", 0.0}}).rays(),
              RayAny & ~RayIndirect);
    EXPECT_EQ(MarkedPrim({{"patina:visibility:volume", 0.0}}).rays(), RayAny & ~RayVolume);
}

TEST(PrimMarks, KarmaHasExpressions) {
    EXPECT_EQ(karma("*"), unsigned(RayAny));
    EXPECT_EQ(karma(""), 0u);
    EXPECT_EQ(karma("-*"), 0u);
    EXPECT_EQ(karma("primary"), unsigned(RayCamera));
    EXPECT_EQ(karma("primary|shadow"), unsigned(RayCamera | RayShadow));
    EXPECT_EQ(karma("-primary"), RayAny & ~RayCamera);
    EXPECT_EQ(karma("-diffuse & -reflect & -refract"), unsigned(RayCamera | RayShadow | RayVolume));
    EXPECT_EQ(karma("* ^shadow"), RayAny & ~RayShadow);
}

TEST(PrimMarks, MarksThatHideNothingMoreAreNoNews) {
    const MarkedPrim clear({{"arnold:visibility:specular_transmit", 0.0},
                            {"arnold:visibility:diffuse_transmit", 0.0},
                            {"arnold:visibility:subsurface", 0.0}});
    EXPECT_EQ(clear.rays(), RayAny & ~RayTransmission);
    EXPECT_EQ(clear.diagnostics.count(), 0);
    EXPECT_EQ(MarkedPrim({{"arnold:visibility:diffuse_transmit", 1.0}}).diagnostics.count(), 0);
}

TEST(PrimMarks, LaterRowsAreStronger) {
    EXPECT_EQ(
        MarkedPrim({{"arnold:visibility:camera", 0.0}, {"patina:visibility:camera", 1.0}}).rays(),
        unsigned(RayAny));
    EXPECT_EQ(MarkedPrim({{"patina:visibility:indirect", 0.0}, {"patina:visibility:diffuse", 1.0}})
                  .rays(),
              unsigned(RayCamera | RayShadow | RayDiffuse));
}

TEST(PrimMarks, MattesAndCatchers) {
    EXPECT_TRUE(MarkedPrim({{"arnold:matte", 1.0}}).prim.catching.matte);
    EXPECT_TRUE(MarkedPrim({{"ri:attributes:Ri:Matte", 1.0}}).prim.catching.matte);
    EXPECT_TRUE(MarkedPrim({{"karma:object:holdoutmode", 1.0}}).prim.catching.matte);
    const MarkedPrim background({{"karma:object:holdoutmode", 2.0}});
    EXPECT_TRUE(background.prim.catching.shadows && background.prim.catching.reflections);
    EXPECT_FALSE(background.prim.catching.matte);
    EXPECT_FALSE(MarkedPrim({{"patina:matte", 0.0}}).prim.catching.any());
}

TEST(PrimMarks, NamesOfMattes) {
    const MarkedPrim named({{"patina:cryptoObject", "hero"}, {"patina:cryptoAsset", "set"}});
    EXPECT_EQ(named.prim.matteName, "hero");
    EXPECT_EQ(named.prim.assetName, "set");
}

TEST(PrimMarks, ValuesThatMeanNothingAreTold) {
    for (const auto& [name, value] : Marks{{"karma:object:rendervisibility", "-sideways"},
                                           {"karma:object:holdoutmode", 7.0},
                                           {"arnold:visibility", -1.0},
                                           {"arnold:visibility:diffuse_transmit", 0.0},
                                           {"patina:cryptoObject", 3.0},
                                           {"patina:matte", "yes"}}) {
        const MarkedPrim marked({{name, value}});
        ASSERT_EQ(marked.diagnostics.count(), 1) << name;
        EXPECT_EQ(marked.diagnostics.all()[0].input, "primvars:" + name);
        EXPECT_EQ(marked.rays(), unsigned(RayAny)) << name;
        EXPECT_FALSE(marked.prim.catching.any()) << name;
    }
}
