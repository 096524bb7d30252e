// SPDX-License-Identifier: Apache-2.0
// Primvars of instances: what is read, of which instance, and what is reported.
#include "hdDelegate/compiled/instanceValues.h"

#include "hdDelegate/scene/tests/prims.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace patina {
namespace {

using Read = std::array<float, 4>;
constexpr Read untouched{-1, -1, -1, -1};

Instancer ofThree(std::vector<Primvar> primvars) {
    Instancer prim;
    prim.path = "/trees";
    prim.transforms.resize(3);
    prim.primvars = std::move(primvars);
    return prim;
}

/// `untouched` where there is no value.
Read valueOf(const InstanceValues& values, const std::string& name, int instance) {
    Read out = untouched;
    if (!values.read(name, instance, out.data())) {
        EXPECT_EQ(out, untouched) << name << ": what is not there leaves all as it was";
    }
    return out;
}

TEST(InstanceValues, AreOnePerInstanceOrOneForAll) {
    const Instancer prim =
        ofThree({makePrimvar("tint", Interpolation::Varying, 3, {0, 1, 2, 10, 11, 12, 20, 21, 22}),
                 makePrimvar("size", Interpolation::Constant, 1, {7}),
                 makePrimvar("st", Interpolation::Vertex, 2, {0, 1, 2, 3, 4, 5})});
    Diagnostics diagnostics;
    const InstanceValues values(prim, diagnostics);
    EXPECT_EQ(valueOf(values, "tint", 0), (Read{0, 1, 2, 0}));
    EXPECT_EQ(valueOf(values, "tint", 2), (Read{20, 21, 22, 0}));
    EXPECT_EQ(valueOf(values, "st", 1), (Read{2, 3, 0, 0}));
    for (int i = 0; i < 3; ++i)
        EXPECT_EQ(valueOf(values, "size", i), (Read{7, 0, 0, 0}));
    EXPECT_EQ(values.names(), (std::vector<std::string>{"instanceId", "tint", "size", "st"}));
    EXPECT_TRUE(diagnostics.all().empty());
}

TEST(InstanceValues, OfOtherNamesAndInstancesAreNone) {
    const Instancer prim = ofThree({makePrimvar("size", Interpolation::Constant, 1, {7})});
    Diagnostics diagnostics;
    const InstanceValues values(prim, diagnostics);
    EXPECT_EQ(valueOf(values, "sizes", 0), untouched);
    for (const int outside : {-1, 3, 1 << 30}) {
        EXPECT_EQ(valueOf(values, "size", outside), untouched);
        EXPECT_EQ(valueOf(values, "instanceId", outside), untouched);
    }
}

TEST(InstanceValues, HaveIdsUnlessTheseAreAuthored) {
    Instancer prim = ofThree({});
    prim.ids = {42, 43}; // too few: the others count
    Diagnostics diagnostics;
    const InstanceValues values(prim, diagnostics);
    EXPECT_EQ(valueOf(values, "instanceId", 1), (Read{43, 0, 0, 0}));
    EXPECT_EQ(valueOf(values, "instanceId", 2), (Read{2, 0, 0, 0}));
    const Instancer own =
        ofThree({makePrimvar("instanceId", Interpolation::Varying, 1, {5, 6, 7})});
    EXPECT_EQ(valueOf(InstanceValues(own, diagnostics), "instanceId", 2), (Read{7, 0, 0, 0}));
}

TEST(InstanceValues, OfTheWrongNumberOrNoNumbersAreReported) {
    const Instancer prim = ofThree({makePrimvar("few", Interpolation::Varying, 1, {1, 2}),
                                    makePrimvar("odd", Interpolation::Varying, 1, {1, NAN, 3})});
    Diagnostics diagnostics;
    const InstanceValues values(prim, diagnostics);
    EXPECT_EQ(valueOf(values, "few", 0), untouched);
    for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(std::isfinite(valueOf(values, "odd", i)[0]));
    ASSERT_EQ(diagnostics.all().size(), 2u);
    for (const auto& entry : diagnostics.all())
        EXPECT_EQ(entry.prim, "/trees");
}

TEST(InstanceValues, OfTheInnermostInstanceThatHasThemAreRead) {
    Diagnostics diagnostics;
    const Instancer outer = ofThree({makePrimvar("tint", Interpolation::Constant, 1, {1}),
                                     makePrimvar("size", Interpolation::Constant, 1, {2})});
    const Instancer inner = ofThree({makePrimvar("tint", Interpolation::Varying, 1, {3, 4, 5})});
    const InstanceValues ofOuter(outer, diagnostics), ofInner(inner, diagnostics);
    const InstanceStep steps[] = {{&ofOuter, 0}, {nullptr, 0}, {&ofInner, 1}};
    Read out = untouched;
    ASSERT_TRUE(readInstances(steps, 3, "tint", out.data()));
    EXPECT_EQ(out[0], 4.0f);
    ASSERT_TRUE(readInstances(steps, 3, "size", out.data()));
    EXPECT_EQ(out[0], 2.0f);
    ASSERT_TRUE(readInstances(steps, 2, "tint", out.data()));
    EXPECT_EQ(out[0], 1.0f) << "the inner one is no step of this place";
    EXPECT_FALSE(readInstances(steps, 3, "colour", out.data()));
    EXPECT_FALSE(readInstances(steps, 0, "tint", out.data()));
}

} // namespace
} // namespace patina
