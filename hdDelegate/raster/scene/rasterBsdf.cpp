// SPDX-License-Identifier: Apache-2.0
#include "hdDelegate/raster/scene/rasterBsdf.h"

#include "hdDelegate/raster/gl/glContext.h"
#include "hdDelegate/raster/gl/glProgram.h"
#include "hdDelegate/raster/scene/rasterTextures.h"
#include "materialNetwork/glsl/glslMaterial.h"
#include "shaders/shaders.h"

#include <algorithm>

namespace patina {

namespace {

std::string shaderOf(const MaterialProgram& program, const GlslMaterial& glsl) {
    std::string primvars = "vec4 primvar(int slot, vec4 fallback) {\n";
    for (size_t i = 0; i < program.primvars().size(); ++i)
        if (program.primvars()[i].type == ValueType::Vec2)
            primvars += "    if (slot == " + std::to_string(i) +
                        ") return probeUv.z != 0.0 ? vec4(probeUv.xy, fallback.zw) : fallback;\n";
    return glsl.definitions +
           "#include \"shaders/raster/material.glsl\"\n"
           "layout(location = 0) uniform vec4 probeUv;\n" +
           glsl.text + glsl.albedoText + primvars +
           "    return fallback;\n}\n#include \"shaders/raster/bsdf.comp.glsl\"\n";
}

} // namespace

struct RasterBsdf::Gpu {
    std::shared_ptr<GlContext> context;
    std::string text; ///< that the program was compiled from
    std::shared_ptr<GlProgram> program;
    bool sharesShader = false;
    GlBuffer parameters, albedoTable;
    std::vector<std::shared_ptr<const GlTexture>> textures;
};

RasterBsdf::RasterBsdf(std::unique_ptr<Gpu> gpu) : _gpu(std::move(gpu)) {}

RasterBsdf::~RasterBsdf() {
    // Objects made with the context go before it.
    const std::shared_ptr<GlContext> context = _gpu->context;
    const GlContext::Use use(*context);
    _gpu.reset();
}

std::unique_ptr<RasterBsdf> RasterBsdf::make(std::shared_ptr<const MaterialProgram> program,
                                             const TextureSystem& textures,
                                             Diagnostics& diagnostics, std::string& error,
                                             const std::vector<const RasterBsdf*>& like) {
    auto gpu = std::make_unique<Gpu>();
    gpu->context = like.empty() ? GlContext::create(error) : like[0]->_gpu->context;
    if (!gpu->context) return nullptr;
    const GlContext::Use use(*gpu->context);
    if (!use.ok()) {
        error = "the OpenGL context cannot be used";
        return nullptr;
    }
    const GlslMaterial glsl = makeGlslMaterial(program->ir());
    for (const Message& what : glsl.leftOut)
        diagnostics.warn("", "", what);
    gpu->text = shaderOf(*program, glsl);
    for (const RasterBsdf* other : like)
        if (other->_gpu->text == gpu->text) gpu->program = other->_gpu->program;
    gpu->sharesShader = gpu->program != nullptr;
    if (!gpu->sharesShader)
        gpu->program = GlProgram::make({{GL_COMPUTE_SHADER, "material", gpu->text}}, error);
    if (!gpu->program) return nullptr;
    gpu->parameters = GlBuffer(glsl.parameters);
    gpu->albedoTable = GlBuffer(sh::ALBEDO_TABLE_SIZE * sizeof(float), patinaAlbedoTable);
    RasterTextures uploaded(textures, diagnostics, GL_RGBA32F);
    gpu->textures = uploaded.units(glsl.textures);
    return std::unique_ptr<RasterBsdf>(new RasterBsdf(std::move(gpu)));
}

bool RasterBsdf::sharesShader() const {
    return _gpu->sharesShader;
}

std::vector<RasterBsdf::Answer> RasterBsdf::evaluate(const std::vector<Query>& queries,
                                                     const glm::vec2* uv) const {
    std::vector<Answer> answers(queries.size());
    if (queries.empty()) return answers;
    const GlContext::Use use(*_gpu->context);
    constexpr size_t batch = 65535; // groups that every driver takes at once
    for (size_t begin = 0; begin < queries.size(); begin += batch) {
        const size_t count = std::min(batch, queries.size() - begin);
        const GlBuffer in(count * sizeof(Query), &queries[begin]);
        const GlBuffer out(count * sizeof(Answer), nullptr);
        in.bindStorage(0);
        out.bindStorage(6);
        _gpu->albedoTable.bindStorage(7);
        _gpu->parameters.bindUniform(1);
        for (size_t i = 0; i < _gpu->textures.size(); ++i)
            _gpu->textures[i]->bind(GLuint(i));
        _gpu->program->use();
        gl.Uniform4f(0, uv ? uv->x : 0.0f, uv ? uv->y : 0.0f, uv ? 1.0f : 0.0f, 0.0f);
        gl.DispatchCompute(GLuint(count), 1, 1);
        gl.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        out.read(&answers[begin], count * sizeof(Answer));
    }
    return answers;
}

} // namespace patina
