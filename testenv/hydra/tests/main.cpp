// SPDX-License-Identifier: Apache-2.0
// Finds the plugin of this build without any environment variable, then runs the tests.

#include <pxr/base/plug/registry.h>

#include <gtest/gtest.h>

int main(int argc, char** argv) {
    PXR_NS::PlugRegistry::GetInstance().RegisterPlugins(PATINA_HYDRA_PLUGIN_FOLDER);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
