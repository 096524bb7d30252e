// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glContext.h"

#include <gtest/gtest.h>

/// Leaves a test that needs OpenGL with one line where there is none. Defines `context` and makes
/// it current for the rest of the scope.
#define PATINA_NEED_CONTEXT()                                                                      \
    std::string contextError;                                                                      \
    const auto context = patina::GlContext::create(contextError);                                  \
    if (!context) GTEST_SKIP() << contextError;                                                    \
    const patina::GlContext::Use useContext(*context);                                             \
    ASSERT_TRUE(useContext.ok())
