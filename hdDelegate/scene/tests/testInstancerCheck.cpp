// SPDX-License-Identifier: Apache-2.0
// Warnings about instancers that ask for more than is drawn.
#include "hdDelegate/scene/instancerCheck.h"

#include <gtest/gtest.h>

#include <limits>

using namespace patina;

namespace {

Instancer twoInstances() {
    Instancer instancer;
    instancer.path = "/World/trees";
    instancer.prototypes = {"oak"};
    instancer.prototypeIndices = {0, 0};
    instancer.transforms.resize(2);
    return instancer;
}

} // namespace

TEST(InstancerCheck, saysNothingOfWhatIsDrawn) {
    const Instancer instancer = twoInstances();
    Diagnostics diagnostics;
    warnOfInstances(instancer, 0.0f, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(InstancerCheck, tellsOfInstancesThatAreLeftOut) {
    Instancer instancer = twoInstances();
    instancer.prototypeIndices[1] = 3;
    instancer.transforms[0] = MotionTransform(mat4(0.0f));
    Diagnostics diagnostics;
    warnOfInstances(instancer, 0.0f, diagnostics);
    EXPECT_EQ(diagnostics.count(), 2);
}

TEST(InstancerCheck, tellsWhatIsWrongWithATransform) {
    dmat4 far(1.0), flat(1.0), none(1.0);
    far[3].x = 1e19;
    flat[2].z = 0.0;
    none[1].y = std::numeric_limits<double>::quiet_NaN();
    const auto reported = [](const dmat4& m) {
        MotionTransform moving(mat4(1.0f));
        moving.values.push_back(m);
        const std::string problem = placeProblem(moving);
        EXPECT_EQ(isPlace(moving), problem.empty());
        if (!problem.empty()) {
            EXPECT_EQ(inverseProblem(m), problem);
        }
        return inverseProblem(m);
    };
    EXPECT_NE(reported(far).find("too large"), std::string::npos);
    EXPECT_NE(reported(flat).find("inverse"), std::string::npos);
    EXPECT_NE(reported(none).find("not finite"), std::string::npos);
    EXPECT_EQ(reported(dmat4(1.0)), "");
}
