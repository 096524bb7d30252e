// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/compiled/compiledScene.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

TEST(CompiledScene, IsOnePerScene) {
    const auto scene = std::make_shared<Scene>(), other = std::make_shared<Scene>();
    const auto compiled = CompiledScene::of(scene);
    EXPECT_EQ(CompiledScene::of(scene), compiled);
    EXPECT_NE(CompiledScene::of(other), compiled);
    EXPECT_EQ(compiled->scene(), scene);
}

TEST(CompiledScene, EndsWithItsLastRenderer) {
    const auto scene = std::make_shared<Scene>();
    const std::weak_ptr<CompiledScene> watched = CompiledScene::of(scene);
    EXPECT_TRUE(watched.expired());
    EXPECT_EQ(scene.use_count(), 1);
    EXPECT_NE(CompiledScene::of(scene), nullptr);
}

} // namespace
} // namespace patina
