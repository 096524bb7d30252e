#include "hdDelegate/raster/glKernel.h"

#include "hdDelegate/raster/glResources.h"

namespace patina {

namespace {

constexpr GLint buffersOfItems = 8; // as many as any item has

const char* const vertexMain = R"(
void main() {
    item(gl_VertexID);
    gl_Position = vec4(0.0);
}
)";
const char* const computeMain = R"(
layout(local_size_x = 64) in;
layout(location = 63) uniform int itemCount;
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i < itemCount) item(i);
}
)";

} // namespace

std::unique_ptr<GlKernel> GlKernel::make(const std::string& name, const std::string& text,
                                         std::string& error) {
    GLint buffers = 0;
    gl.GetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &buffers);
    auto kernel = std::make_unique<GlKernel>();
    kernel->_compute = buffers < buffersOfItems;
    const GlStage stage = kernel->_compute ? GlStage{GL_COMPUTE_SHADER, name, text + computeMain}
                                           : GlStage{GL_VERTEX_SHADER, name, text + vertexMain};
    kernel->_program = GlProgram::make({stage}, error);
    return kernel->_program ? std::move(kernel) : nullptr;
}

void GlKernel::run(int count) const {
    _program->use();
    if (_compute) {
        gl.Uniform1i(63, count);
        gl.DispatchCompute(GLuint(count + 63) / 64, 1, 1);
    } else {
        // Nothing is drawn into it, but without a window there is no other.
        const GlTexture target(GL_TEXTURE_2D, GL_R8, 1, 1);
        const GlFramebuffer framebuffer({&target}, nullptr);
        framebuffer.bind();
        GLuint noAttributes = 0;
        gl.CreateVertexArrays(1, &noAttributes);
        gl.BindVertexArray(noAttributes);
        gl.Enable(GL_RASTERIZER_DISCARD);
        gl.DrawArrays(GL_POINTS, 0, count);
        gl.Disable(GL_RASTERIZER_DISCARD);
        gl.DeleteVertexArrays(1, &noAttributes);
    }
    gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
}

} // namespace patina
