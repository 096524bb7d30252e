// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/scene/primMarks.h"

#include <gtest/gtest.h>

using namespace patina;

namespace {

struct Marked {
    Mesh prim;
    Diagnostics diagnostics;

    explicit Marked(const Marks& marks) {
        prim.path = "/prim";
        applyMarks(marks, prim, diagnostics);
    }
    unsigned rays() const { return prim.visibility.mask(); }
};

unsigned karma(const std::string& text) {
    return Marked({{"karma:object:rendervisibility", text}}).rays();
}

} // namespace

TEST(PrimMarks, EveryRendererHidesFromTheRaysThatItNames) {
    EXPECT_EQ(Marked({}).rays(), unsigned(RayAny));
    EXPECT_EQ(Marked({{"arnold:visibility:camera", 0.0}}).rays(), RayAny & ~RayCamera);
    EXPECT_EQ(Marked({{"arnold:visibility:specular_reflect", 0.0}}).rays(), RayAny & ~RaySpecular);
    EXPECT_EQ(Marked({{"arnold:visibility", 255.0 - 2.0}}).rays(), RayAny & ~RayShadow);
    EXPECT_EQ(Marked({{"ri:attributes:visibility:transmission", 0.0}}).rays(), RayAny & ~RayShadow);
    EXPECT_EQ(Marked({{"ri:attributes:visibility:indirect", 0.0}}).rays(), RayAny & ~RayIndirect);
    EXPECT_EQ(Marked({{"patina:visibility:volume", 0.0}}).rays(), RayAny & ~RayVolume);
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
    const Marked clear({{"arnold:visibility:specular_transmit", 0.0},
                        {"arnold:visibility:diffuse_transmit", 0.0},
                        {"arnold:visibility:subsurface", 0.0}});
    EXPECT_EQ(clear.rays(), RayAny & ~RayTransmission);
    EXPECT_EQ(clear.diagnostics.count(), 0);
    EXPECT_EQ(Marked({{"arnold:visibility:diffuse_transmit", 1.0}}).diagnostics.count(), 0);
}

TEST(PrimMarks, LaterRowsAreStronger) {
    EXPECT_EQ(Marked({{"arnold:visibility:camera", 0.0}, {"patina:visibility:camera", 1.0}}).rays(),
              unsigned(RayAny));
    EXPECT_EQ(
        Marked({{"patina:visibility:indirect", 0.0}, {"patina:visibility:diffuse", 1.0}}).rays(),
        unsigned(RayCamera | RayShadow | RayDiffuse));
}

TEST(PrimMarks, MattesAndCatchers) {
    EXPECT_TRUE(Marked({{"arnold:matte", 1.0}}).prim.catching.matte);
    EXPECT_TRUE(Marked({{"ri:attributes:Ri:Matte", 1.0}}).prim.catching.matte);
    EXPECT_TRUE(Marked({{"karma:object:holdoutmode", 1.0}}).prim.catching.matte);
    const Marked background({{"karma:object:holdoutmode", 2.0}});
    EXPECT_TRUE(background.prim.catching.shadows && background.prim.catching.reflections);
    EXPECT_FALSE(background.prim.catching.matte);
    EXPECT_FALSE(Marked({{"patina:matte", 0.0}}).prim.catching.any());
}

TEST(PrimMarks, NamesOfMattes) {
    const Marked named({{"patina:cryptoObject", "hero"}, {"patina:cryptoAsset", "set"}});
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
        const Marked marked({{name, value}});
        ASSERT_EQ(marked.diagnostics.count(), 1) << name;
        EXPECT_EQ(marked.diagnostics.all()[0].input, "primvars:" + name);
        EXPECT_EQ(marked.rays(), unsigned(RayAny)) << name;
        EXPECT_FALSE(marked.prim.catching.any()) << name;
    }
}
