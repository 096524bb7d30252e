// SPDX-License-Identifier: Apache-2.0
// The context, and a program on it: what is drawn comes back, and what is wrong is told by name.

#include "hdDelegate/raster/gl/glDownload.h"
#include "hdDelegate/raster/tests/rasterFixture.h"

#include <EGL/egl.h>

#include <glm/glm.hpp>

#include <cstdlib>
#include <vector>

using namespace patina;

TEST(RasterContext, ComputesWithALobe) {
    PATINA_NEED_CONTEXT();
    const auto program = computeProgram("test", R"(
#include "shaders/compat/glsl.glsl"
#include "shaders/lobes.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Result { vec4 result[]; };
void main() {
    OrenNayarLobe l = orenNayarSetup(vec3(0.5), 0.0, false);
    vec3 n = vec3(0.0, 0.0, 1.0);
    result[gl_GlobalInvocationID.x] = vec4(orenNayarEval(l, n, n).value, 1.0);
}
)");
    ASSERT_TRUE(program);
    const GlBuffer result(2 * 4 * sizeof(float), nullptr);
    result.bindStorage(0);
    const auto values = computed<float>(*program, 2, result, 8);
    EXPECT_NEAR(values[0], 0.5 / 3.14159265, 1e-6);
    EXPECT_EQ(values[7], 1.0f);
    EXPECT_EQ(gl.GetError(), GLenum(GL_NO_ERROR));
}

TEST(RasterContext, ASmallBufferHoldsNothingOfWhatFollowsItsData) {
    PATINA_NEED_CONTEXT();
    const unsigned char data[GlBuffer::minSize] = {1,    2,    3,    4,    0xaa, 0xaa, 0xaa, 0xaa,
                                                   0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa, 0xaa};
    const GlBuffer buffer(4, data);
    ASSERT_EQ(buffer.size(), GlBuffer::minSize);
    unsigned char held[GlBuffer::minSize] = {};
    buffer.read(held, sizeof held);
    for (size_t i = 0; i < sizeof held; ++i)
        EXPECT_EQ(held[i], i < 4 ? data[i] : 0) << i;
}

TEST(RasterContext, ReadsLargeImagesInBands) {
    PATINA_NEED_CONTEXT();
    constexpr int width = 17, height = 23;
    std::vector<glm::vec4> drawn;
    for (int i = 0; i < width * height; ++i)
        drawn.emplace_back(float(i), 1.0f, 2.0f, 3.0f);
    const GlTexture texture(GL_TEXTURE_2D, GL_RGBA32F, width, height);
    gl.TextureSubImage2D(texture.id(), 0, 0, 0, width, height, GL_RGBA, GL_FLOAT, drawn.data());
    for (const size_t most : {size_t(1), size_t(1000), size_t(1) << 30}) {
        std::vector<glm::vec4> read(drawn.size(), glm::vec4(-1.0f));
        GlDownload download(most);
        download.read(texture, GL_RGBA, GL_FLOAT, read.size() * sizeof(glm::vec4), read.data());
        EXPECT_EQ(read, drawn) << most;
    }
}

TEST(RasterContext, NamesFileAndLineOfAnError) {
    PATINA_NEED_CONTEXT();
    std::string error;
    EXPECT_FALSE(GlProgram::make({{GL_COMPUTE_SHADER, "broken",
                                   "#include \"shaders/lib/lobe.glsl\"\n"
                                   "layout(local_size_x = 1) in;\n"
                                   "void main() { lobeMean(vec3(0.0)); }\n"}},
                                 error));
    // Drivers write the line behind a colon or in brackets.
    EXPECT_TRUE(error.find("shaders/lib/lobe.glsl:") != std::string::npos ||
                error.find("shaders/lib/lobe.glsl(") != std::string::npos)
        << error;
    EXPECT_FALSE(
        GlProgram::make({{GL_COMPUTE_SHADER, "lost", "#include \"no/such.glsl\"\n"}}, error));
    EXPECT_NE(error.find("no/such.glsl"), std::string::npos) << error;
}

TEST(RasterContext, LeavesTheHostsContextCurrent) {
    std::string error;
    const auto host = GlContext::create(error);
    if (!host) GTEST_SKIP() << error;
    EXPECT_EQ(eglGetCurrentContext(), EGL_NO_CONTEXT);
    const GlContext::Use hostUse(*host);
    const EGLContext before = eglGetCurrentContext();
    EXPECT_NE(before, EGL_NO_CONTEXT);
    {
        const auto own = GlContext::create(error);
        ASSERT_TRUE(own) << error;
        EXPECT_EQ(eglGetCurrentContext(), before);
        const GlContext::Use use(*own);
        EXPECT_NE(eglGetCurrentContext(), before);
        EXPECT_FALSE(own->lost());
    }
    EXPECT_EQ(eglGetCurrentContext(), before);
}

TEST(RasterContext, SaysInOneLineWhyThereIsNone) {
    setenv("PATINA_EGL_PLATFORM", "none", 1);
    std::string error;
    EXPECT_FALSE(GlContext::create(error));
    EXPECT_FALSE(error.empty());
    EXPECT_EQ(error.find('\n'), std::string::npos);
    unsetenv("PATINA_EGL_PLATFORM");
}
