// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "hdDelegate/raster/gl/glContext.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/gl/glResources.h"

#include <gtest/gtest.h>

namespace patina {

/// A program of one compute shader, which has to be sound.
inline std::unique_ptr<GlProgram> computeProgram(const std::string& name, const std::string& text) {
    std::string error;
    auto program = GlProgram::make({{GL_COMPUTE_SHADER, name, text}}, error);
    EXPECT_TRUE(program) << error << "\n" << text;
    return program;
}

/// Runs a program. @returns so many values of a storage buffer
template <class T> std::vector<T> computed(const GlProgram& program, size_t groups,
                                           const GlBuffer& result, size_t count) {
    program.use();
    gl.DispatchCompute(GLuint(groups), 1, 1);
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<T> values(count);
    result.read(values.data(), count * sizeof(T));
    return values;
}

} // namespace patina

/// Leaves a test that needs OpenGL with one line where there is none. Defines `context` and makes
/// it current for the rest of the scope.
#define PATINA_NEED_CONTEXT()                                                                      \
    std::string contextError;                                                                      \
    const auto context = patina::GlContext::create(contextError);                                  \
    if (!context) GTEST_SKIP() << contextError;                                                    \
    const patina::GlContext::Use useContext(*context);                                             \
    ASSERT_TRUE(useContext.ok())
