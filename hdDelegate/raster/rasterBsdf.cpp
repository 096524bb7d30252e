#include "hdDelegate/raster/rasterBsdf.h"

#include "hdDelegate/raster/eglContext.h"
#include "hdDelegate/raster/glKernel.h"
#include "hdDelegate/raster/rasterTextures.h"
#include "materialNetwork/glsl/glslMaterial.h"
#include "shaders/shaders.h"

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
           "    return fallback;\n}\n#include \"shaders/raster/bsdf.glsl\"\n";
}

} // namespace

struct RasterBsdf::Gpu {
    std::unique_ptr<EglContext> context;
    std::unique_ptr<GlKernel> kernel;
    GlBuffer parameters, albedoTable;
    std::vector<std::shared_ptr<const GlTexture>> textures;
};

RasterBsdf::RasterBsdf(std::unique_ptr<Gpu> gpu) : _gpu(std::move(gpu)) {}

RasterBsdf::~RasterBsdf() {
    // What was made with the context goes before it.
    const std::unique_ptr<EglContext> context = std::move(_gpu->context);
    const EglContext::Use use(*context);
    _gpu.reset();
}

std::unique_ptr<RasterBsdf> RasterBsdf::make(std::shared_ptr<const MaterialProgram> program,
                                             const TextureSystem& textures,
                                             Diagnostics& diagnostics, std::string& error) {
    auto gpu = std::make_unique<Gpu>();
    gpu->context = EglContext::create(error);
    if (!gpu->context) return nullptr;
    const EglContext::Use use(*gpu->context);
    if (!use.ok()) {
        error = "the OpenGL context cannot be used";
        return nullptr;
    }
    const GlslMaterial glsl = makeGlslMaterial(*program);
    for (const std::string& line : glsl.leftOut)
        diagnostics.warn("", "", line);
    gpu->kernel = GlKernel::make("material", shaderOf(*program, glsl), error);
    if (!gpu->kernel) return nullptr;
    gpu->parameters = GlBuffer(glsl.parameters);
    gpu->albedoTable = GlBuffer(sh::ALBEDO_TABLE_SIZE * sizeof(float), patinaAlbedoTable);
    RasterTextures uploaded(textures, diagnostics, GL_RGBA32F);
    gpu->textures = uploaded.units(glsl.textures);
    return std::unique_ptr<RasterBsdf>(new RasterBsdf(std::move(gpu)));
}

std::vector<RasterBsdf::Answer> RasterBsdf::evaluate(const std::vector<Query>& queries,
                                                     const glm::vec2* uv) const {
    std::vector<Answer> answers(queries.size());
    if (queries.empty()) return answers;
    const EglContext::Use use(*_gpu->context);
    const GlBuffer in(queries.size() * sizeof(Query), queries.data());
    const GlBuffer out(queries.size() * sizeof(Answer), nullptr);
    in.bindStorage(0);
    out.bindStorage(6);
    _gpu->albedoTable.bindStorage(7);
    _gpu->parameters.bindUniform(1);
    for (size_t i = 0; i < _gpu->textures.size(); ++i)
        _gpu->textures[i]->bind(GLuint(i));
    _gpu->kernel->use();
    gl.Uniform4f(0, uv ? uv->x : 0.0f, uv ? uv->y : 0.0f, uv ? 1.0f : 0.0f, 0.0f);
    _gpu->kernel->run(int(queries.size()));
    out.read(answers.data(), answers.size() * sizeof(Answer));
    return answers;
}

} // namespace patina
