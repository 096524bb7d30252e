// What is told of instancers that ask for more than is drawn.
#include "hdDelegate/scene/instancerCheck.h"

#include <gtest/gtest.h>

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
    Instancer instancer = twoInstances();
    instancer.primvars.resize(1);
    instancer.primvars[0].name = "wind";
    instancer.primvars[0].interpolation = Interpolation::Constant;
    Diagnostics diagnostics;
    warnOfInstancePrimvars(instancer, diagnostics);
    warnOfInstances(instancer, 0.0f, diagnostics);
    EXPECT_EQ(diagnostics.count(), 0);
}

TEST(InstancerCheck, namesThePrimvar) {
    Instancer instancer = twoInstances();
    instancer.primvars.resize(1);
    instancer.primvars[0].name = "displayColor";
    instancer.primvars[0].interpolation = Interpolation::Vertex;
    Diagnostics diagnostics;
    warnOfInstancePrimvars(instancer, diagnostics);
    ASSERT_EQ(diagnostics.count(), 1);
    EXPECT_EQ(diagnostics.all()[0].prim, "/World/trees");
    EXPECT_EQ(diagnostics.all()[0].input, "primvars:displayColor");
}

TEST(InstancerCheck, tellsOfInstancesThatAreLeftOut) {
    Instancer instancer = twoInstances();
    instancer.prototypeIndices[1] = 3;
    instancer.transforms[0] = MotionTransform(mat4(0.0f));
    Diagnostics diagnostics;
    warnOfInstances(instancer, 0.0f, diagnostics);
    EXPECT_EQ(diagnostics.count(), 2);
}
